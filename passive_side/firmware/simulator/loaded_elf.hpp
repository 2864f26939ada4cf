// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sim_elf.h>

#include <cstdint>
#include <filesystem>

namespace telehug {

// A firmware's file: what elf_read_firmware() has allocated and avr_load_firmware() copies; libsimavr never frees it.
class LoadedElf {
 public:
  // Throws std::runtime_error if it can't be read.
  explicit LoadedElf(const std::filesystem::path& elf);
  ~LoadedElf();
  LoadedElf(const LoadedElf&) = delete;
  LoadedElf& operator=(const LoadedElf&) = delete;

  // The first address of RAM that no static has. Throws std::runtime_error if the file does not say.
  [[nodiscard]] std::uint32_t end_of_statics() const;

  elf_firmware_t content{};
};

}  // namespace telehug
