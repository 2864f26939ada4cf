// SPDX-License-Identifier: Apache-2.0
//
// What the firmware takes of the controller's memory: the table in its README is compared with the programs.
#include <elf.h>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <iostream>
#include <iterator>
#include <map>
#include <random>
#include <sstream>

#include "unit/firmware/virtual_jacket.hpp"

namespace telehug {
namespace {

using protocol::FrameType;

constexpr int flash_bytes = 32'768;
constexpr int ram_bytes = 2'048;
constexpr int spare_bytes = 512;  // of RAM, at least: neither statics nor the deepest stack
constexpr int tolerance_bytes = 16;

struct Figures {
  int flash = 0;
  int statics = 0;
  int stack = 0;
};

template <typename Part>
Part part_at(const std::string& file, std::size_t at) {
  Part part{};
  std::memcpy(&part, file.data() + at, sizeof part);
  return part;
}

std::map<std::string, int> section_sizes(const std::filesystem::path& elf) {
  std::ifstream stream(elf, std::ios::binary);
  const std::string file{std::istreambuf_iterator<char>(stream), {}};
  const auto header = part_at<Elf32_Ehdr>(file, 0);
  const auto section = [&](std::size_t i) {
    return part_at<Elf32_Shdr>(file, header.e_shoff + i * header.e_shentsize);
  };
  const std::size_t names = section(header.e_shstrndx).sh_offset;
  std::map<std::string, int> sizes;
  for (std::size_t i = 0; i < header.e_shnum; ++i) {
    sizes[file.data() + names + section(i).sh_name] = static_cast<int>(section(i).sh_size);
  }
  return sizes;
}

// The line never idle: drives of all motors, heat, questions, and what is no frame.
void load_heavily(VirtualJacket& jacket, const BoardWiring& board) {
  std::mt19937 random(7);
  jacket.hello();
  for (int i = 0; i < 250; ++i) {
    FramePayload set;
    for (std::size_t channel = 0; channel < board.motors.size(); ++channel) {
      for (const std::uint8_t value :
           {static_cast<std::uint8_t>(channel), static_cast<std::uint8_t>(random() & 0xFFU), std::uint8_t{25}})
        set.push_back(value);
    }
    jacket.say(FrameType::set, set);
    jacket.say(FrameType::heat, {0, 0x7C, 1, 25, 1, 0x7C, 1, 25});
    jacket.say(FrameType::status);
    if (i % 10 == 0) jacket.say(FrameType::hello, {1, 1, 0, 0});
    std::vector<std::uint8_t> bytes(1 + random() % 30);
    std::ranges::generate(bytes, [&] { return static_cast<std::uint8_t>(random() & 0x1FU); });
    bytes.push_back(0);
    jacket.say_bytes(bytes);
  }
}

Figures measure(const BoardWiring& board) {
  const auto sizes = section_sizes(std::filesystem::path(TELEHUG_FIRMWARE_FOLDER) / board.elf);
  const auto size = [&](const std::string& name) { return sizes.contains(name) ? sizes.at(name) : 0; };
  Figures figures{size(".text") + size(".data"), size(".data") + size(".bss") + size(".noinit"), 0};
  VirtualJacket jacket(board);
  load_heavily(jacket, board);
  EXPECT_EQ(jacket.chip.resets(), 0U);
  EXPECT_EQ(jacket.chip.uart_overruns(), 0U) << board.name;
  figures.stack = ram_bytes - figures.statics - static_cast<int>(jacket.chip.untouched_ram());
  return figures;
}

// "| `board` | flash | statics | stack |"
std::map<std::string, Figures> told_in_readme() {
  std::ifstream readme(TELEHUG_SOURCE "/passive_side/firmware/README.md");
  std::map<std::string, Figures> told;
  for (std::string line; std::getline(readme, line);) {
    std::array<char, 32> board{};
    Figures figures;
    if (std::sscanf(line.c_str(), "| `%31[a-z0-9_]` | %d | %d | %d |", board.data(), &figures.flash, &figures.statics,
                    &figures.stack) == 4) {
      told[board.data()] = figures;
    }
  }
  return told;
}

TEST(FirmwareFigures, AreThoseOfItsReadmeAndLeaveRoom) {
  const auto told = told_in_readme();
  EXPECT_EQ(told.size(), board_wirings().size());
  for (const BoardWiring& board : board_wirings()) {
    const Figures measured = measure(board);
    std::cout << fmt::format("| `{}` | {} | {} | {} |\n", board.name, measured.flash, measured.statics, measured.stack);
    EXPECT_LE(measured.flash, flash_bytes / 4);
    EXPECT_LE(measured.statics + measured.stack, ram_bytes - spare_bytes);
    EXPECT_GT(measured.stack, 10) << "the stack was measured";
    const auto found = told.find(std::string(board.name));
    const Figures row = found == told.end() ? Figures{} : found->second;
    EXPECT_NEAR(row.flash, measured.flash, tolerance_bytes) << board.name << ": write the line above into the README";
    EXPECT_NEAR(row.statics, measured.statics, tolerance_bytes) << board.name;
    EXPECT_NEAR(row.stack, measured.stack, tolerance_bytes) << board.name;
  }
}

}  // namespace
}  // namespace telehug
