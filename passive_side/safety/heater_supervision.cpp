// SPDX-License-Identifier: Apache-2.0
#include "safety/heater_supervision.hpp"

#include <algorithm>
#include <cmath>

#include "jacket/jacket_profile.hpp"

namespace telehug {
namespace {

constexpr double cutoff_celsius = protocol::heat_cutoff_decidegrees / 10.0;

}  // namespace

void HeaterSupervision::pass(bool heating, Duration time) noexcept {
  if (time <= Duration{}) return;
  if (heating) {
    heated_ = std::min(heated_ + time, longest_heating);
    cools_down_ = cools_down_ || heated_ == longest_heating;
    return;
  }
  constexpr Duration::rep faster = longest_heating / heater_cool_down;
  heated_ -= std::min(heated_, std::min(time, heater_cool_down) * faster);
  cools_down_ = cools_down_ && heated_ > Duration{};
}

std::optional<JacketTelemetry::Heater> HeaterSupervision::reading(const std::optional<JacketTelemetry>& telemetry,
                                                                  Timestamp now) const noexcept {
  const bool fresh = telemetry && telemetry->heard <= now && now - telemetry->heard <= oldest_heater_telemetry;
  if (!fresh || heater_ >= telemetry->heaters.size()) return std::nullopt;
  return telemetry->heaters[heater_];
}

HeaterState HeaterSupervision::state(const std::optional<JacketTelemetry>& telemetry, Timestamp now) const noexcept {
  const auto told = reading(telemetry, now);
  if (!told) return HeaterState::no_telemetry;
  if (told->fault == protocol::HeaterFault::cooling_down) return HeaterState::cooling_down;
  if (told->fault != protocol::HeaterFault::none) return HeaterState::fault;
  if (!told->celsius || !std::isfinite(*told->celsius)) return HeaterState::no_reading;
  if (*told->celsius >= cutoff_celsius) return HeaterState::too_warm;
  return cools_down_ ? HeaterState::cooling_down : HeaterState::ready;
}

double set_point_celsius(double strength, double most) noexcept {
  const double limit = std::min(most, most_celsius);
  // Written so that it is false for NaN.
  if (!(strength > 0) || !std::isfinite(strength) || !(limit >= least_celsius)) return 0;
  const double celsius = least_celsius + std::min(strength, 1.0) * (limit - least_celsius);
  return std::floor(celsius * 10 + 1e-6) / 10;  // a tenth is what travels: never the next one above the limit
}

}  // namespace telehug
