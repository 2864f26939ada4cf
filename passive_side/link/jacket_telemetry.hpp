// SPDX-License-Identifier: Apache-2.0
//
// What the microcontroller tells of itself, in volts, degrees and words.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "link/frame_codec.hpp"
#include "link/jacket_link.hpp"

namespace telehug {

// Below it a battery is about to give up; a motor then moves little, and the microcontroller may reset.
inline constexpr double weak_supply_volts = 4.5;

// Empty if it is no telemetry, or tells of another number of temperatures than the jacket announced. A temperature that
// no sensor on a body can have counts as no reading.
[[nodiscard]] std::optional<JacketTelemetry> read_telemetry(const Frame& frame, std::size_t temperatures,
                                                            Timestamp heard);

// Why the microcontroller started last: "power-on", "watchdog, brown-out" or the like; "unknown" for none.
[[nodiscard]] std::string reset_cause_text(std::uint8_t mcusr);

// "sensor open", "too hot" and so on; "none".
[[nodiscard]] std::string heater_fault_text(protocol::HeaterFault fault);

// What is wrong with a jacket that goes on working, each with what to do about it.
struct JacketWarning {
  std::string what;
  std::string_view to_do;
};
using JacketWarnings = boost::container::static_vector<JacketWarning, 2>;
[[nodiscard]] JacketWarnings warnings(const JacketTelemetry& telemetry);

}  // namespace telehug
