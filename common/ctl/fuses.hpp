// SPDX-License-Identifier: Apache-2.0
//
// The fuses of an ATmega328P that carries telehug's firmware without a bootloader. A fuse bit is programmed when it is
// 0.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace telehug {

struct Fuses {
  std::uint8_t low = 0;
  std::uint8_t high = 0;
  std::uint8_t extended = 0;  // its upper five bits do not exist; they may read as anything
};

// What is wrong with them, a sentence each; empty: nothing.
[[nodiscard]] std::vector<std::string> faults_of(const Fuses& fuses);

// What avrdude is told in order to mend those bytes that have a fault, such as "-U", "hfuse:w:0xD9:m". The bits that
// have no fault keep their values.
[[nodiscard]] std::vector<std::string> mending_of(const Fuses& fuses);

}  // namespace telehug
