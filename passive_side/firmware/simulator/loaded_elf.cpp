// SPDX-License-Identifier: Apache-2.0
#include "simulator/loaded_elf.hpp"

#include <cstdlib>
#include <stdexcept>
#include <string>
#include <string_view>

namespace telehug {
namespace {

// Of avr-gcc's linker, in whose address space RAM begins there.
constexpr std::string_view end_symbol = "_end";
constexpr std::uint32_t ram_offset = 0x800000;

}  // namespace

LoadedElf::LoadedElf(const std::filesystem::path& elf) {
  if (elf_read_firmware(elf.c_str(), &content) != 0) {
    throw std::runtime_error("can't read the firmware " + elf.string() + ": build it, or name another with --firmware");
  }
}

LoadedElf::~LoadedElf() {
  std::free(content.flash);
  std::free(content.eeprom);
  std::free(content.fuse);
  std::free(content.lockbits);
  for (std::uint32_t i = 0; i < content.symbolcount; ++i)
    std::free(content.symbol[i]);
  std::free(static_cast<void*>(content.symbol));
}

std::uint32_t LoadedElf::end_of_statics() const {
  for (std::uint32_t i = 0; i < content.symbolcount; ++i) {
    if (end_symbol == content.symbol[i]->symbol) return content.symbol[i]->addr - ram_offset;
  }
  throw std::runtime_error("this firmware has no symbols: build it without stripping");
}

}  // namespace telehug
