// SPDX-License-Identifier: Apache-2.0
#include "manual/config_page.hpp"

#include <fmt/core.h>

#include "cli/roff.hpp"
#include "config/key.hpp"
#include "config/reload.hpp"

namespace telehug {
namespace {

constexpr std::string_view form = R"(.PP
The format is TOML. A key that is left out has its default.
Lengths are in mm or px, times in ms; the unit is a part of each key's name, or told with it.
)";

constexpr std::string_view checks = R"(.SH CHECKING
.B telehug config check
tells all faults at once, each with file and line;
.B telehug config show
which value counts and where it comes from;
.B telehug config diff
what differs from the defaults.
A daemon does not start with a faulty configuration.
)";

std::string keys_text(const std::vector<Key>& keys, const LiveKeys& live) {
  std::string text;
  std::string_view section;
  for (const Key& key : keys) {
    if (key.section != section) text += fmt::format(".SS {}\n", roff_argument(fmt::format("[{}]", key.section)));
    section = key.section;
    const std::string limits = limits_text(key.limits);
    std::string note = key.unit.empty() ? limits : fmt::format("{} {}", limits, key.unit);
    if (limits.empty()) note = key.unit;
    text += roff_item(fmt::format("{} = {}", key.name, toml_text(key.target)),
                      fmt::format("{}{}{}", key.help, note.empty() ? "" : fmt::format(" ({})", note),
                                  is_live(key.path(), live) ? " [reload]" : ""));
  }
  return text;
}

std::string files_text(std::string_view side) {
  std::string text = ".SH FILES\nRead in this order; later ones win, key by key.\n";
  const auto item = [&](const std::string& file, std::string_view what) { text += roff_item(file, what); };
  item(fmt::format("/etc/telehug/{}.toml", side), "Of this PC.");
  item(fmt::format("/etc/telehug/{}.d/*.toml", side), "Parts of it, sorted by name.");
  item(fmt::format("$XDG_CONFIG_HOME/telehug/{0}.toml, $XDG_CONFIG_HOME/telehug/{0}.d/*.toml", side),
       "The same two of the user; without the variable in ~/.config.");
  item("--config FILE", "In place of all those.");
  item("--set SECTION.KEY=VALUE", "Last.");
  return text;
}

std::string page(std::string_view side, const std::vector<Key>& keys, const LiveKeys& live, std::string_view date) {
  std::string text = roff_title(fmt::format("telehug-{}.toml", side), 5, date);
  text += fmt::format(".SH NAME\ntelehug\\-{0}.toml \\- configuration of telehug\\-{0}\n", side);
  text += fmt::format(".SH SYNOPSIS\n.I {}\n", roff(fmt::format("/etc/telehug/{}.toml", side)));
  text += fmt::format(".SH DESCRIPTION\nWhat\n.BR telehug\\-{} (1)\ndoes, and with what.\n", side);
  text += form;
  text +=
      ".SH KEYS\nEach is shown at its default. A reload (SIGHUP) takes over those marked [reload]; all others need a "
      "restart.\n" +
      keys_text(keys, live);
  text += files_text(side);
  text += checks;
  text += fmt::format(".SH SEE ALSO\n.BR telehug\\-{} (1),\n.BR telehug (1),\n.BR telehug (7)\n", side);
  return text;
}

}  // namespace

std::string config_page(Side side, std::string_view date) {
  if (side == Side::active) {
    ActiveConfig defaults;
    return page("active", keys_of(defaults), live_keys(side), date);
  }
  PassiveConfig defaults;
  return page("passive", keys_of(defaults), live_keys(side), date);
}

}  // namespace telehug
