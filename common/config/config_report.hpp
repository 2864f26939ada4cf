// SPDX-License-Identifier: Apache-2.0
//
// A configuration as it is told to a person: which value counts, where it comes from, what is wrong.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "config/key.hpp"
#include "config/load.hpp"

namespace telehug {

struct KeySetting {
  std::string section;
  std::string name;
  std::string value;       // as it is written in a file
  std::string standard;    // the default, likewise
  std::string origin;      // "file:line", or the flag; empty: nothing sets it
  bool free_text = false;  // may hold anything a person writes: names, addresses
};

struct ConfigReport {
  std::vector<KeySetting> settings;          // of every key, in the order of the shipped file
  std::vector<Fault> faults;                 // a daemon starts only if there is none
  std::vector<std::filesystem::path> files;  // that were read
};

// A key with a fault is told as it was before.
[[nodiscard]] ConfigReport inspect_config(const ConfigSources& sources, Side side);

// The configuration as far as it can be read: keys with faults are as they were before. For programs that look at what
// is wrong.
[[nodiscard]] ActiveConfig readable_active_config(const ConfigSources& sources);
[[nodiscard]] PassiveConfig readable_passive_config(const ConfigSources& sources);

}  // namespace telehug
