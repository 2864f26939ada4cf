// SPDX-License-Identifier: Apache-2.0
#include "ctl/config_choice.hpp"

#include <CLI/CLI.hpp>

namespace telehug {

std::vector<Side> ConfigChoice::sides() const {
  if (side == "active") return {Side::active};
  if (side == "passive") return {Side::passive};
  return {Side::active, Side::passive};
}

ConfigSources ConfigChoice::sources() const {
  ConfigSources sources = usual_config_sources();
  if (system) sources.user_folder.clear();
  if (!file.empty()) sources.only_file = file;
  sources.overrides = overrides;
  return sources;
}

void add_config_choice(CLI::App& command, ConfigChoice& choice) {
  command.add_option("side", choice.side, "Of this side alone (default: both)")
      ->check(CLI::IsMember({"active", "passive"}));
  command.add_option("--config", choice.file, "Read only this file")->type_name("FILE");
  command.add_flag("--system", choice.system, "As a system service reads it: without the user's own files");
}

}  // namespace telehug
