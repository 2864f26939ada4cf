// SPDX-License-Identifier: Apache-2.0
//
// avrdude (GPL, run as a program of its own), asked and told what writing the jacket's firmware needs.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/result.hpp"
#include "ctl/avrdude_output.hpp"

namespace telehug {

// How avrdude reaches the chip.
struct AvrdudeWay {
  std::string programmer = "arduino";  // avrdude's -c; "arduino" is a serial bootloader
  std::string port;                    // -P; empty: avrdude's own for this programmer
  int baud = 0;                        // -b; 0: avrdude's own for this programmer
};

// The command line that reaches the chip this way, before what is to be done there.
[[nodiscard]] std::vector<std::string> avrdude_command(const AvrdudeWay& way);

struct FoundBootloader {
  BootloaderVersion version;
  int baud = 0;
};

// Asks at both speeds that bootloaders of these boards have; resets the board each time. Up to half a minute if nothing
// answers. Errors of all these are a sentence with what avrdude said and what to do.
[[nodiscard]] Result<FoundBootloader> find_bootloader(const std::string& port);

[[nodiscard]] Result<Fuses> read_fuses(const AvrdudeWay& way);

// `words` as mending_of() gives them. avrdude reads them again and compares.
[[nodiscard]] Status write_fuses(const AvrdudeWay& way, const std::vector<std::string>& words);

// Writes the flash and compares it; the number of bytes.
[[nodiscard]] Result<int> write_flash(const AvrdudeWay& way, const std::filesystem::path& hex_file);

}  // namespace telehug
