// SPDX-License-Identifier: Apache-2.0
#include "link/jacket_telemetry.hpp"

#include <fmt/core.h>

#include <array>

namespace telehug {
namespace {

using protocol::HeaterFault;

// MCUSR of the ATmega328P (data sheet DS40002061, 11.9.1).
constexpr std::uint8_t power_on = 1;
constexpr std::uint8_t brown_out = 4;
constexpr std::uint8_t watchdog = 8;
struct ResetCause {
  std::uint8_t bit;
  const char* name;
};
constexpr std::array<ResetCause, 4> reset_causes{
    {{power_on, "power-on"}, {2, "reset line"}, {brown_out, "brown-out"}, {watchdog, "watchdog"}}};

constexpr std::array<const char*, 7> fault_names{
    "none", "sensor open", "sensor short", "too hot", "does not get warm", "gets warm too fast", "cooling down"};

// What the sensors of worn heaters can tell at all.
constexpr int coldest_decidegrees = -400;
constexpr int hottest_decidegrees = 1500;

std::optional<double> celsius_of(std::int16_t decidegrees) {
  if (decidegrees < coldest_decidegrees || decidegrees > hottest_decidegrees) return std::nullopt;
  return decidegrees / 10.0;
}

}  // namespace

std::optional<JacketTelemetry> read_telemetry(const Frame& frame, std::size_t temperatures, Timestamp heard) {
  const auto received = parse_telemetry(frame);
  if (!received || received->temperatures.size() != temperatures) return std::nullopt;
  JacketTelemetry telemetry;
  telemetry.heard = heard;
  telemetry.supply_volts = received->supply_mv / 1000.0;
  telemetry.reset_cause = received->reset_cause;
  telemetry.frames_malformed = received->frames_malformed;
  telemetry.bytes_overrun = received->bytes_overrun;
  for (const Temperature& temperature : received->temperatures)
    telemetry.heaters.push_back({celsius_of(temperature.decidegrees), temperature.fault});
  return telemetry;
}

std::string reset_cause_text(std::uint8_t mcusr) {
  std::string text;
  for (const ResetCause& cause : reset_causes) {
    if ((mcusr & cause.bit) == 0) continue;
    if (!text.empty()) text += ", ";
    text += cause.name;
  }
  return text.empty() ? "unknown" : text;
}

std::string heater_fault_text(HeaterFault fault) {
  const auto number = static_cast<std::size_t>(fault);
  return number < fault_names.size() ? fault_names.at(number) : fmt::format("unknown fault {}", number);
}

JacketWarnings warnings(const JacketTelemetry& telemetry) {
  JacketWarnings list;
  if (telemetry.supply_volts > 0 && telemetry.supply_volts < weak_supply_volts) {
    list.push_back({fmt::format("the jacket's supply is weak: {:.2f} V", telemetry.supply_volts),
                    "charge its battery, or check its power supply and cable"});
  }
  // With the power comes a brown-out, too, where it rises slowly.
  const bool sagged = (telemetry.reset_cause & brown_out) != 0 && (telemetry.reset_cause & power_on) == 0;
  if (sagged || (telemetry.reset_cause & watchdog) != 0) {
    list.push_back({fmt::format("the jacket has started again by itself ({})", reset_cause_text(telemetry.reset_cause)),
                    sagged ? "its supply has sagged: charge its battery, or check its power supply"
                           : "its program hung; if that happens again, update its firmware"});
  }
  return list;
}

}  // namespace telehug
