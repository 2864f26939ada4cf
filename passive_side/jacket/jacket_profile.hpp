// SPDX-License-Identifier: Apache-2.0
//
// What a jacket is: its actuators, where they sit on the body, and how strong each may get. Loaded from
// deploy/jackets/*.toml by load_jacket_profile.hpp, which guarantees every range stated here.
#pragma once

#include <chrono>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/clock.hpp"
#include "common/units.hpp"
#include "jacket/drive.hpp"

namespace telehug {

inline constexpr int jacket_profile_format = 2;
inline constexpr std::uint8_t motor_channels = 16;  // of the microcontroller: 0..15
inline constexpr std::uint8_t heater_channels = 2;  // numbered beside them: 0..1

// The grid to which a profile's box numbers refer (thesis: five boxes of half a face height per row, centred on the
// midline, from the chin down).
inline constexpr int standard_columns = 5;
inline constexpr double standard_box_side_fh = 0.5;
inline constexpr int standard_rows = 20;  // farther down than any camera sees
inline constexpr int largest_box = standard_columns * standard_rows;

// Number of the box that a place lies in; 0: beside the grid, or nowhere. Of two boxes a place on their edge is in the
// one to the right, or below.
[[nodiscard]] inline int standard_box_at(BodyPoint place) noexcept {
  const double column = std::floor(place.x_fh / standard_box_side_fh + standard_columns / 2.0);
  const double row = std::floor(place.y_fh / standard_box_side_fh);
  const bool inside = column >= 0 && column < standard_columns && row >= 0 && row < standard_rows;  // false for NaN
  return inside ? static_cast<int>(row) * standard_columns + static_cast<int>(column) + 1 : 0;
}

enum class ActuatorKind : std::uint8_t { motor, heater };
enum class BodySide : std::uint8_t { front, back };

// What the microcontroller speaks.
enum class JacketProtocol : std::uint8_t {
  telehug,  // link/protocol.hpp
  legacy,   // the thesis' sketch: a bare box number starts a pulse; no answer, no stop
};

// What the microcontroller hangs on; any, where the profile does not say.
enum class JacketWire : std::uint8_t { any, serial, bluetooth };

// How a touch finds its actuators.
enum class Rendering : std::uint8_t {
  places,  // those about its place on the body, each the stronger the nearer it is
  boxes,   // those that serve its box, all alike
};

// What to do with a touch whose box no actuator serves.
enum class Uncovered : std::uint8_t {
  nearest,  // the actuator that is nearest to it on the body
  none,     // nothing; the sender is told
};

struct Actuator {
  std::uint8_t id = 0;  // 1..255, unique
  std::string name;
  ActuatorKind kind = ActuatorKind::motor;
  std::uint8_t channel = 0;  // motors 0..15, heaters 0..1; unique of its kind
  BodyPoint place;           // x positive: right edge of the screen, the wearer's own left (units.hpp)
  BodySide side = BodySide::front;
  std::vector<std::uint16_t> boxes;  // of the standard grid, 1..largest_box
  double max_strength = 1;           // of full power, 0..1; nothing exceeds it
  double min_strength = 0;           // least that turns, 0..max_strength
  bool enabled = true;               // false: the wearer's own file has switched it off
  // Of motors:
  double gamma = 1;       // 0.2..5: strength^gamma is what is spread over min_strength..max_strength
  Duration kick{};        // 0..100 ms at max_strength, to start it
  double current_ma = 0;  // at full power
  double max_duty = 1;    // above 0, at most 1: share of the profile's duty_window at max_strength
  // Of heaters:
  double max_celsius = 40;  // set-point of strength 1: above least_celsius, at most 40
};

// Set-point of a heater at the least strength: about what skin has under clothes.
inline constexpr double least_celsius = 32;
inline constexpr double most_celsius = 40;

struct JacketProfile {
  int version = jacket_profile_format;
  std::string name;
  int baud = 0;
  JacketProtocol protocol = JacketProtocol::telehug;
  JacketWire wire = JacketWire::any;
  Uncovered uncovered = Uncovered::none;
  Rendering rendering = Rendering::boxes;
  double supply_ma = 0;  // what all motors together may draw; 0: not limited
  Duration duty_window = std::chrono::seconds(10);
  std::vector<Actuator> actuators;  // 1..max_actuators
  std::vector<std::string> notes;   // what the author may want to know; no faults

  // Place in `actuators`.
  [[nodiscard]] std::optional<std::size_t> index_of(std::uint8_t id) const noexcept {
    for (std::size_t index = 0; index < actuators.size(); ++index) {
      if (actuators[index].id == id) return index;
    }
    return std::nullopt;
  }
};

}  // namespace telehug
