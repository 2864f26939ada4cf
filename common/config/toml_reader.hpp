// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "config/key.hpp"

namespace telehug {

// Reads one file into the keys' targets. Every fault is added to `faults`; keys without a fault are stored all the
// same, so that the faults of all layers can be told at once.
void read_toml_file(const std::filesystem::path& file, std::vector<Key>& keys, std::vector<Fault>& faults);

// The same for text in memory; `name` stands for the file in the faults.
void read_toml_text(std::string text, const std::string& name, std::vector<Key>& keys, std::vector<Fault>& faults);

}  // namespace telehug
