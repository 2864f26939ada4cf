// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "common/clock.hpp"
#include "link/jacket_link.hpp"
#include "link/protocol.hpp"

namespace telehug {

// Why a heater may not heat; the first that applies.
enum class HeaterState : std::uint8_t {
  ready,
  no_telemetry,  // for 2 s or ever
  no_reading,    // no valid temperature: no sensor, no heater
  fault,         // the microcontroller says so (HeaterFault)
  too_warm,      // its sensor has reached the microcontroller's cut-off
  cooling_down,  // it has heated for as long as it may
};

inline constexpr Duration oldest_heater_telemetry = std::chrono::seconds(2);
inline constexpr Duration longest_heating = std::chrono::seconds(protocol::heat_on_max_s);
inline constexpr Duration heater_cool_down = std::chrono::seconds(protocol::heat_cool_down_s);

// Watches one heater beside the microcontroller, which does the same by itself. After longest_heating the heater is
// off for heater_cool_down; what it has heated before wears off at the same rate while it is off, so that short breaks
// lengthen nothing.
class HeaterSupervision {
 public:
  // heater: of the microcontroller, its number.
  explicit HeaterSupervision(std::uint8_t heater) noexcept : heater_(heater) {}

  // It was commanded to heat, or not, for `time` since the last call.
  void pass(bool heating, Duration time) noexcept;

  [[nodiscard]] HeaterState state(const std::optional<JacketTelemetry>& telemetry, Timestamp now) const noexcept;

  // What the telemetry says of it; nothing if it is too old or says nothing.
  [[nodiscard]] std::optional<JacketTelemetry::Heater> reading(const std::optional<JacketTelemetry>& telemetry,
                                                               Timestamp now) const noexcept;

 private:
  std::uint8_t heater_;
  Duration heated_{};  // 0..longest_heating
  bool cools_down_ = false;
};

// From strength 0..1 to a set-point: least_celsius .. the least of `most` and most_celsius. 0 if strength is not above
// 0 or no number, or if the limits leave nothing.
[[nodiscard]] double set_point_celsius(double strength, double most) noexcept;

}  // namespace telehug
