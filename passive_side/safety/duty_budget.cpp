// SPDX-License-Identifier: Apache-2.0
#include "safety/duty_budget.hpp"

#include <algorithm>
#include <numeric>

#include "safety/shares.hpp"

namespace telehug {
namespace {

double seconds(Duration duration) {
  return std::chrono::duration<double>(duration).count();
}

constexpr double share_that_fades = 0.2;

}  // namespace

DutyBudget::DutyBudget(double max_duty, Duration window) noexcept
    : limited_(max_duty < 1),
      budget_s_(max_duty * seconds(window)),
      part_(std::max(Duration{1}, window / static_cast<Duration::rep>(parts) + Duration{1})) {}

void DutyBudget::run(double strength, Duration time, Timestamp now) noexcept {
  if (!limited_ || time <= Duration{}) return;
  slide(now);
  used_s_[present_] += std::max(strength, 0.0) * seconds(time);
}

double DutyBudget::most(Timestamp now) noexcept {
  if (!limited_) return 1;
  slide(now);
  const double left_s = budget_s_ - used_s();
  // A command must never outlast what is left.
  const double fades_s = std::max(seconds(longest_command), budget_s_ * share_that_fades);
  return std::clamp(left_s / fades_s, 0.0, 1.0);
}

double DutyBudget::used(Timestamp now) noexcept {
  if (!limited_) return 0;
  slide(now);
  return std::min(used_s() / budget_s_, 1.0);
}

double DutyBudget::used_s() const noexcept {
  return std::accumulate(used_s_.begin(), used_s_.end(), 0.0);
}

// A clock that goes back takes nothing out of the window: all parts just get earlier numbers.
void DutyBudget::slide(Timestamp now) noexcept {
  const std::int64_t number = now.time_since_epoch() / part_;
  const std::int64_t passed = std::min<std::int64_t>(number - present_number_, parts + 1);
  for (std::int64_t part = 0; part < passed; ++part) {
    present_ = (present_ + 1) % used_s_.size();
    used_s_[present_] = 0;
  }
  present_number_ = number;
}

}  // namespace telehug
