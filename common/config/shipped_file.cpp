// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include "config/key.hpp"
#include "config/load.hpp"
#include "config/reload.hpp"

namespace telehug {
namespace {

std::string written(const std::vector<Key>& keys, Side which) {
  const std::string_view side = which == Side::active ? "active" : "passive";
  std::string text = fmt::format(
      "# telehug, {} side. Every key is shown at its default; take the # away to change it.\n"
      "# Read in this order, later ones win: /etc/telehug/{}.toml, /etc/telehug/{}.d/*.toml, the same in\n"
      "# ~/.config/telehug/, --config FILE (in place of those before), --set SECTION.KEY=VALUE.\n"
      "# A reload (systemctl reload, or SIGHUP) takes over what is marked [reload]; all else needs a restart.\n",
      side, side, side);
  if (which == Side::active)
    text +=
        "# The set-up page writes camera, screen and monitor into active.d/50-setup.toml, which wins over this file.\n";
  std::string_view section;
  for (const Key& key : keys) {
    if (key.section != section) text += fmt::format("\n[{}]\n", key.section);
    section = key.section;
    const std::string limits = limits_text(key.limits);
    std::string note;
    if (!limits.empty()) note = key.unit.empty() ? limits : fmt::format("{} {}", limits, key.unit);
    text += fmt::format("# {}{}{}\n", key.help, note.empty() ? "" : fmt::format(" ({})", note),
                        is_live(key.path(), live_keys(which)) ? " [reload]" : "");
    text += fmt::format("#{} = {}\n", key.name, toml_text(key.target));
  }
  return text;
}

}  // namespace

std::string shipped_config_file(Side side) {
  if (side == Side::active) {
    ActiveConfig defaults;
    return written(keys_of(defaults), Side::active);
  }
  PassiveConfig defaults;
  return written(keys_of(defaults), Side::passive);
}

}  // namespace telehug
