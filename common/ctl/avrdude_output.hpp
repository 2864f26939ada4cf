// SPDX-License-Identifier: Apache-2.0
//
// What avrdude (7.1, in the C locale) prints.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "ctl/fuses.hpp"

namespace telehug {

// What a bootloader says of itself (STK500 parameters 0x80 to 0x82, Atmel AVR061).
struct BootloaderVersion {
  int hardware = 0;
  int major = 0;
  int minor = 0;
};

// From `avrdude -v`.
[[nodiscard]] std::optional<BootloaderVersion> bootloader_in(std::string_view output);

// optiboot of a version that switches the watchdog off before it starts the program.
[[nodiscard]] bool is_good_optiboot(const BootloaderVersion& bootloader);

// From `-U lfuse:r:-:h -U hfuse:r:-:h -U efuse:r:-:h`.
[[nodiscard]] std::optional<Fuses> fuses_in(std::string_view output);

// How many bytes of the flash hold what they should.
[[nodiscard]] std::optional<int> verified_bytes_in(std::string_view output);

// Why avrdude failed: its own words, and what to do.
struct AvrdudeFailure {
  std::string line;
  std::string advice;
};
[[nodiscard]] AvrdudeFailure failure_in(std::string_view output);

}  // namespace telehug
