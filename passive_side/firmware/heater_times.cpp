// SPDX-License-Identifier: Apache-2.0
#include "heater_times.hpp"

#include "board.hpp"
#include "reading_rate.hpp"

namespace protocol = telehug::protocol;

namespace {

constexpr uint16_t longest_use = readings_in_ms(1000UL * protocol::heat_on_max_s);
constexpr uint16_t cooling_bit = 0x8000;

static_assert(protocol::heat_on_max_s == 2 * protocol::heat_cool_down_s, "it is given back twice as fast as used");
static_assert(longest_use < cooling_bit, "both fit into a word");

// Not cleared at start-up. The copy tells what an earlier run has left from what the power has.
uint16_t used[board::heater_count] __attribute__((section(".noinit")));
uint16_t inverted_copy[board::heater_count] __attribute__((section(".noinit")));

void store(uint8_t heater, uint16_t value) {
  used[heater] = value;
  inverted_copy[heater] = static_cast<uint16_t>(~value);
}

}  // namespace

namespace heater_times {

void init() {
  for (uint8_t heater = 0; heater < board::heater_count; ++heater) {
    const uint16_t value = used[heater];
    const bool left_by_a_run =
        inverted_copy[heater] == static_cast<uint16_t>(~value) && (value & ~cooling_bit) <= longest_use;
    if (!left_by_a_run) store(heater, 0);
  }
}

void pass(uint8_t heater, bool in_use) {
  uint16_t value = used[heater] & static_cast<uint16_t>(~cooling_bit);
  bool cooling = cooling_down(heater);
  if (in_use && !cooling) {
    cooling = ++value >= longest_use;
  } else {
    value = value > 2 ? value - 2 : 0;
    cooling = cooling && value != 0;
  }
  store(heater, cooling ? value | cooling_bit : value);
}

bool cooling_down(uint8_t heater) {
  return (used[heater] & cooling_bit) != 0;
}

}  // namespace heater_times
