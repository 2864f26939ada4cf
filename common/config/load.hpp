// SPDX-License-Identifier: Apache-2.0
//
// From files and flags to a configuration. Later layers win, key by key:
//   /etc/telehug/SIDE.toml, /etc/telehug/SIDE.d/*.toml (sorted by name), the same two in the user's folder,
//   the file of --config (which replaces the layers before it), --set SECTION.KEY=VALUE.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/messages.hpp"
#include "common/result.hpp"
#include "config/config.hpp"

namespace telehug {

struct ConfigSources {
  std::filesystem::path system_folder;  // empty: not read
  std::filesystem::path user_folder;    // empty: not read
  std::optional<std::filesystem::path> only_file;
  std::vector<std::string> overrides;  // "section.key=value"
};

// /etc/telehug and $XDG_CONFIG_HOME/telehug (~/.config/telehug), without a file of its own or overrides.
[[nodiscard]] ConfigSources usual_config_sources();

// The error lists every fault of every layer, one a line, as "FILE:LINE: sentence".
[[nodiscard]] Result<ActiveConfig> load_active_config(const ConfigSources& sources);
[[nodiscard]] Result<PassiveConfig> load_passive_config(const ConfigSources& sources);

// The files that are read for a side, in this order. A folder that can't be listed is named as if it were a file, so
// that reading it tells the fault.
[[nodiscard]] std::vector<std::filesystem::path> config_files(const ConfigSources& sources, Side side);

// The file that is shipped for a side: every key commented out, at its default, with unit, range and help.
[[nodiscard]] std::string shipped_config_file(Side side);

}  // namespace telehug
