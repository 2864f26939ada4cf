// SPDX-License-Identifier: Apache-2.0
#include "doubles/firmware_board.hpp"

#include <cstdlib>
#include <utility>

#include "analog.hpp"
#include "board.hpp"
#include "heaters.hpp"
#include "motors.hpp"
#include "uart.hpp"
#include "watchdog.hpp"

namespace {

struct Board {
  bool armed = false;
  bool changing = false;
  std::uint16_t running = 0;
  std::uint8_t room = 255;
  std::vector<std::uint8_t> written;
};
Board now;  // NOLINT(cppcoreguidelines-avoid-non-const-global-variables): what it stands for is one of a kind, too

void require(bool holds) {
  if (!holds) std::abort();
}

}  // namespace

namespace telehug::firmware_board {

void reset() {
  now = {};
}

void disarm() {
  now.armed = false;
  now.running = 0;
}

void set_room(std::uint8_t bytes) {
  now.room = bytes;
}

std::vector<std::uint8_t> take_written() {
  return std::exchange(now.written, {});
}

}  // namespace telehug::firmware_board

namespace motors {

void arm() {
  now.armed = true;
  now.running = 0;
}
bool armed() {
  return now.armed;
}
void host_lives() {
  require(now.armed);
}
void begin_change() {
  require(now.armed && !now.changing);
  now.changing = true;
}
void set(uint8_t channel, uint8_t intensity, uint16_t duration_ms) {
  require(now.changing && channel < board::motor_count);
  const std::uint32_t bit = 1U << channel;
  const bool runs = intensity != 0 && duration_ms != 0;
  now.running = static_cast<std::uint16_t>(runs ? now.running | bit : now.running & ~bit);
}
void commit_change() {
  require(std::exchange(now.changing, false));
}
void all_off() {
  require(!now.changing);
  now.running = 0;
}
uint16_t running() {
  return now.running;
}

}  // namespace motors

namespace heaters {

void set(uint8_t heater, uint16_t set_point, uint16_t /*duration_ms*/) {
  require(now.armed && heater < board::heater_count && set_point <= telehug::protocol::heat_max_decidegrees);
}
int16_t temperature(uint8_t heater) {
  require(heater < board::heater_count);
  return telehug::protocol::no_temperature;
}
telehug::protocol::HeaterFault fault(uint8_t heater) {
  require(heater < board::heater_count);
  return telehug::protocol::HeaterFault::sensor_open;
}

}  // namespace heaters

namespace uart {

bool has_room(uint8_t length) {
  return length <= now.room;
}
void write(uint8_t byte) {
  now.written.push_back(byte);
}
uint16_t overruns() {
  return 0;
}

}  // namespace uart

namespace analog {

uint16_t supply_mv() {
  return 5000;
}

}  // namespace analog

namespace watchdog {

uint8_t reset_cause() {
  return 0;
}

}  // namespace watchdog
