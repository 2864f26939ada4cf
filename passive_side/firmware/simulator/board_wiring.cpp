// SPDX-License-Identifier: Apache-2.0
#include "simulator/board_wiring.hpp"

#include <algorithm>
#include <array>

namespace telehug {
namespace {

constexpr std::array<BoardPin, 16> motors16{{{'D', 2},
                                             {'D', 3},
                                             {'D', 4},
                                             {'D', 5},
                                             {'D', 6},
                                             {'D', 7},
                                             {'B', 0},
                                             {'B', 1},
                                             {'B', 2},
                                             {'B', 3},
                                             {'B', 4},
                                             {'C', 0},
                                             {'C', 1},
                                             {'C', 2},
                                             {'C', 3},
                                             {'C', 4}}};
constexpr std::array<BoardPin, 12> motors12{{{'D', 2},
                                             {'D', 3},
                                             {'D', 4},
                                             {'D', 5},
                                             {'D', 6},
                                             {'D', 7},
                                             {'B', 0},
                                             {'B', 1},
                                             {'B', 2},
                                             {'B', 3},
                                             {'B', 4},
                                             {'C', 4}}};
constexpr std::array<HeaterWiring, 2> heaters2{{{{'C', 2}, 0}, {{'C', 3}, 1}}};

constexpr std::array<BoardWiring, 3> boards{{
    {"motors16", "telehug-jacket.elf", motors16, {}, {}},
    {"motors12_heaters2", "telehug-jacket-motors12_heaters2.elf", motors12, heaters2, BoardPin{'C', 5}},
    {"legacy", "telehug-jacket-legacy.elf", motors16, {}, {}},
}};

}  // namespace

std::span<const BoardWiring> board_wirings() {
  return boards;
}

const BoardWiring* find_board(std::string_view name) {
  const auto* const board = std::ranges::find(boards, name, &BoardWiring::name);
  return board == boards.end() ? nullptr : board;
}

}  // namespace telehug
