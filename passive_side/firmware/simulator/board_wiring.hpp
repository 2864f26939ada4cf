// SPDX-License-Identifier: Apache-2.0
//
// The boards as README.md of the firmware shows them, on purpose not shared with the firmware's own tables.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace telehug {

struct BoardPin {
  char port = 'B';  // B, C or D
  std::uint8_t bit = 0;
};

struct HeaterWiring {
  BoardPin transistor;
  std::uint8_t thermistor_input = 0;  // of the ADC
};

struct BoardWiring {
  std::string_view name;
  std::string_view elf;  // file name of its firmware
  std::span<const BoardPin> motors;
  std::span<const HeaterWiring> heaters;
  std::optional<BoardPin> heater_supply;  // the transistor that feeds all heaters
};

[[nodiscard]] std::span<const BoardWiring> board_wirings();
// `motors16` is the first. Null if there is none of that name.
[[nodiscard]] const BoardWiring* find_board(std::string_view name);

}  // namespace telehug
