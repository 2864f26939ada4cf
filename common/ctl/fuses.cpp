// SPDX-License-Identifier: Apache-2.0
#include "ctl/fuses.hpp"

#include <fmt/core.h>

#include <array>

namespace telehug {
namespace {

// ATmega328P datasheet (Microchip DS40002061): "Fuse Bits" in the chapter Memory Programming, "Clock Sources" in System
// Clock, "BODLEVEL Fuse Coding" in Electrical Characteristics.
struct Rule {
  std::uint8_t Fuses::*byte;
  std::uint8_t mask;
  std::uint8_t wanted;
  const char* fault;
};

constexpr std::array rules{
    Rule{&Fuses::low, 0x80, 0x80,
         "the clock is divided by 8 (CKDIV8 is programmed): the serial line would be too slow"},
    Rule{&Fuses::low, 0x40, 0x40, "the clock comes out at D8 (CKOUT is programmed), where an actuator may be"},
    Rule{&Fuses::high, 0x10, 0x10,
         "the watchdog runs at 16 ms from the start (WDTON is programmed), for which the firmware is not made"},
    Rule{&Fuses::high, 0x01, 0x01,
         "a reset begins in the bootloader (BOOTRST is programmed), which a programmer erases when it writes"},
    Rule{&Fuses::extended, 0x07, 0x04,
         "the brown-out detector is not at 4.3 V (BODLEVEL is not 100): a falling supply makes the chip miscount"},
};

// CKSEL for a crystal of 8 to 16 MHz: low power 111x, full swing 011x.
bool is_crystal(std::uint8_t low) {
  return (low & 0x06U) == 0x06U;
}

// The crystal that starts slowest: CKSEL and SUT all 1.
constexpr std::uint8_t crystal_bits = 0x3F;

struct Judgement {
  std::vector<std::string> faults;
  Fuses mended;
};

Judgement judge(const Fuses& fuses) {
  Judgement result{{}, fuses};
  for (const Rule& rule : rules) {
    if ((fuses.*rule.byte & rule.mask) == rule.wanted) continue;
    result.faults.emplace_back(rule.fault);
    result.mended.*rule.byte = static_cast<std::uint8_t>((result.mended.*rule.byte & ~rule.mask) | rule.wanted);
  }
  if (!is_crystal(fuses.low)) {
    result.faults.emplace_back("the clock is not the board's crystal of 16 MHz (CKSEL is neither 111x nor 011x)");
    result.mended.low |= crystal_bits;
  }
  return result;
}

}  // namespace

std::vector<std::string> faults_of(const Fuses& fuses) {
  return judge(fuses).faults;
}

std::vector<std::string> mending_of(const Fuses& fuses) {
  const Fuses mended = judge(fuses).mended;
  std::vector<std::string> words;
  const auto set = [&words](const char* name, std::uint8_t from, std::uint8_t to) {
    if (from == to) return;
    words.emplace_back("-U");
    words.push_back(fmt::format("{}:w:0x{:02X}:m", name, to));
  };
  set("lfuse", fuses.low, mended.low);
  set("hfuse", fuses.high, mended.high);
  // The bits that do not exist are written as 1, whatever was read.
  if (mended.extended != fuses.extended) set("efuse", fuses.extended, mended.extended | 0xF8U);
  return words;
}

}  // namespace telehug
