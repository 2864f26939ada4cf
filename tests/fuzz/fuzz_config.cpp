// SPDX-License-Identifier: Apache-2.0
//
// A config file that somebody edited by hand: any text, read for both sides.
#include <cstdint>
#include <string>
#include <vector>

#include "config/toml_reader.hpp"

namespace {

template <typename Config>
void read(const std::string& text) {
  Config config;
  std::vector<telehug::Key> keys = telehug::keys_of(config);
  std::vector<telehug::Fault> faults;
  telehug::read_toml_text(text, "fuzz", keys, faults);
  (void)telehug::impossible_combinations(config, keys);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(data, data + size);
  read<telehug::ActiveConfig>(text);
  read<telehug::PassiveConfig>(text);
  return 0;
}
