// SPDX-License-Identifier: Apache-2.0
#include "rendering/feel.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace telehug {
namespace {

double seconds(Duration duration) {
  return std::chrono::duration<double>(duration).count();
}

struct Adaptation {
  double firm;
  Duration firm_for;
  Duration faded_at;
  double gentle;
  Duration pulse;  // of the gentle pulses, less than half of their period
  Duration period;
};

constexpr Adaptation hold{1, 150ms, 2s, 0.35, 600ms, 1500ms};
constexpr Adaptation hug{0.8, 2s, 3500ms, 0.4, 1200ms, 3s};

constexpr double slow_mm_s = 100;
constexpr double fast_mm_s = 400;
constexpr double slow_level = 0.35;
constexpr double fast_level = 0.6;

constexpr Duration warm_after = 3s;
constexpr Duration warm_at = 13s;

constexpr double steady_per_s = 5;

// From 0 to 1 and back to 0, as the cosine goes.
double hump(double part) {
  return (1 - std::cos(2 * std::numbers::pi * part)) / 2;
}

double adapted(Duration age, const Adaptation& a) {
  if (age <= a.firm_for) return a.firm;
  if (age < a.faded_at) {
    const double part = seconds(age - a.firm_for) / seconds(a.faded_at - a.firm_for);
    return a.firm + (a.gentle - a.firm) * hump(part / 2);
  }
  // Begins at the top of a pulse, where the fading has ended.
  const Duration in_period = (age - a.faded_at + a.pulse / 2) % a.period;
  return in_period < a.pulse ? a.gentle * hump(seconds(in_period) / seconds(a.pulse)) : 0;
}

}  // namespace

double hold_level(Duration rested) noexcept {
  return adapted(rested, hold);
}

double hug_level(Duration held) noexcept {
  return adapted(held, hug);
}

double stroke_level(double speed_mm_s) noexcept {
  if (!(speed_mm_s > slow_mm_s)) return slow_level;  // also what is no number
  const double part = (std::min(speed_mm_s, fast_mm_s) - slow_mm_s) / (fast_mm_s - slow_mm_s);
  return slow_level + part * (fast_level - slow_level);
}

double warmth(Duration rested) noexcept {
  return std::clamp(seconds(rested - warm_after) / seconds(warm_at - warm_after), 0.0, 1.0);
}

double SteadyLevel::follow(double wanted, Timestamp now) noexcept {
  const double step = steady_per_s * seconds(now - at_);
  at_ = now;
  level_ = std::clamp(wanted, level_ - step, level_ + step);
  return level_;
}

}  // namespace telehug
