// SPDX-License-Identifier: Apache-2.0
#include "simulator/heated_patch.hpp"

#include <algorithm>
#include <cmath>

namespace telehug {
namespace {

constexpr double step_s = 0.05;  // short against every lag
constexpr double overvoltage_factor = (14.0 / 5) * (14.0 / 5);
constexpr double divider_ohm = 10'000;

// NTC of 10 kOhm at 25 C, B 3950.
double thermistor_ohm(double celsius) {
  return 10'000 * std::exp(3950 * (1 / (celsius + 273.15) - 1 / 298.15));
}

double equilibrium(const PatchParameters& p, double power_w) {
  return (power_w + p.to_skin_w_per_k * p.skin_celsius + p.to_air_w_per_k * p.air_celsius) /
         (p.to_skin_w_per_k + p.to_air_w_per_k);
}

}  // namespace

HeatedPatch::HeatedPatch(const PatchParameters& given)
    : parameters(given), pad_celsius_(equilibrium(given, 0)), sensor_celsius_(pad_celsius_) {}

void HeatedPatch::advance(double seconds, bool heated) {
  const double full_w = parameters.heater_w * (overvoltage_ ? overvoltage_factor : 1);
  for (double left = seconds; left > 0; left -= step_s) {
    const double dt = std::min(left, step_s);
    const double power_w = heated && !fuse_open_ ? full_w : 0;
    const double pad_lag_s = parameters.pad_j_per_k / (parameters.to_skin_w_per_k + parameters.to_air_w_per_k);
    const double target = equilibrium(parameters, power_w);
    pad_celsius_ = target + (pad_celsius_ - target) * std::exp(-dt / pad_lag_s);
    const bool detached = sensor_break_ == HeaterBreak::detached;
    const double around = detached ? parameters.air_celsius : pad_celsius_;
    const double lag_s = detached ? parameters.detached_lag_s : parameters.sensor_lag_s;
    sensor_celsius_ = around + (sensor_celsius_ - around) * std::exp(-dt / lag_s);
    fuse_open_ |= pad_celsius_ >= parameters.fuse_celsius;
  }
}

void HeatedPatch::break_it(HeaterBreak what) {
  switch (what) {
    case HeaterBreak::open:
    case HeaterBreak::shorted:
    case HeaterBreak::detached:
      sensor_break_ = what;
      break;
    case HeaterBreak::runaway:
      runs_away_ = true;
      break;
    case HeaterBreak::overvoltage:
      overvoltage_ = true;
      break;
  }
}

unsigned HeatedPatch::thermistor_mv(unsigned supply_mv) const {
  if (sensor_break_ == HeaterBreak::open) return supply_mv;
  if (sensor_break_ == HeaterBreak::shorted) return 0;
  const double ohm = thermistor_ohm(sensor_celsius_);
  return static_cast<unsigned>(std::lround(supply_mv * ohm / (ohm + divider_ohm)));
}

}  // namespace telehug
