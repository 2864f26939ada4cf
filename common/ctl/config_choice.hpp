// SPDX-License-Identifier: Apache-2.0
//
// Whose configuration a subcommand is about, and where it lies.
#pragma once

#include <string>
#include <vector>

#include "config/load.hpp"

namespace CLI {
class App;
}

namespace telehug {

struct ConfigChoice {
  std::string side;  // "active", "passive"; empty: both
  std::string file;
  std::vector<std::string> overrides;
  bool system = false;

  [[nodiscard]] std::vector<Side> sides() const;
  [[nodiscard]] ConfigSources sources() const;
};

// The side as a word, --config and --system.
void add_config_choice(CLI::App& command, ConfigChoice& choice);

}  // namespace telehug
