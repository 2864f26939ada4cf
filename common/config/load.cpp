// SPDX-License-Identifier: Apache-2.0
#include "config/load.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "config/config_report.hpp"
#include "config/key.hpp"
#include "config/toml_reader.hpp"

namespace telehug {
namespace {

void apply_override(const std::string& text, std::vector<Key>& keys, std::vector<Fault>& faults) {
  const std::string where = fmt::format("--set {}", text);
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos) {
    faults.push_back({where, "must have the form SECTION.KEY=VALUE"});
    return;
  }
  const std::string path = text.substr(0, equals);
  const auto key = std::find_if(keys.begin(), keys.end(), [&](const Key& k) { return k.path() == path; });
  if (key == keys.end()) {
    faults.push_back({where, fmt::format("there is no key {}", path)});
    return;
  }
  const auto value = value_from_text(*key, std::string_view(text).substr(equals + 1));
  const auto problem = value ? assign(*key, *value) : fmt::format("{} must be {}", path, type_name(key->target));
  if (problem) {
    faults.push_back({where, *problem});
  } else {
    key->origin = where;
  }
}

std::string listing(const std::vector<Fault>& faults) {
  std::string text;
  for (const Fault& fault : faults)
    text += fmt::format("{}{}: {}", text.empty() ? "" : "\n", fault.where, fault.what);
  return text;
}

// All layers, one after the other, into the keys of `config`.
template <typename Config>
std::vector<Fault> read_layers(const ConfigSources& sources, Side side, const Config& config, std::vector<Key>& keys) {
  std::vector<Fault> faults;
  for (const auto& file : config_files(sources, side))
    read_toml_file(file, keys, faults);
  for (const auto& text : sources.overrides)
    apply_override(text, keys, faults);
  for (Fault& fault : impossible_combinations(config, keys))
    faults.push_back(std::move(fault));
  return faults;
}

template <typename Config>
Result<Config> load(const ConfigSources& sources, Side side) {
  Config config;
  std::vector<Key> keys = keys_of(config);
  const std::vector<Fault> faults = read_layers(sources, side, config, keys);
  if (!faults.empty()) return Error{listing(faults)};
  return config;
}

template <typename Config>
Config readable(const ConfigSources& sources, Side side) {
  Config config;
  std::vector<Key> keys = keys_of(config);
  (void)read_layers(sources, side, config, keys);
  return config;
}

template <typename Config>
ConfigReport inspect(const ConfigSources& sources, Side side) {
  Config config;
  std::vector<Key> keys = keys_of(config);
  ConfigReport report;
  for (const Key& key : keys)
    report.settings.push_back(
        {std::string(key.section),
         std::string(key.name),
         {},
         toml_text(key.target),
         {},
         std::holds_alternative<std::string*>(key.target) && !std::holds_alternative<OneOf>(key.limits)});
  report.files = config_files(sources, side);
  report.faults = read_layers(sources, side, config, keys);
  for (std::size_t i = 0; i < keys.size(); ++i) {
    report.settings[i].value = toml_text(keys[i].target);
    report.settings[i].origin = keys[i].origin;
  }
  return report;
}

}  // namespace

Result<ActiveConfig> load_active_config(const ConfigSources& sources) {
  return load<ActiveConfig>(sources, Side::active);
}

Result<PassiveConfig> load_passive_config(const ConfigSources& sources) {
  return load<PassiveConfig>(sources, Side::passive);
}

ActiveConfig readable_active_config(const ConfigSources& sources) {
  return readable<ActiveConfig>(sources, Side::active);
}

PassiveConfig readable_passive_config(const ConfigSources& sources) {
  return readable<PassiveConfig>(sources, Side::passive);
}

ConfigReport inspect_config(const ConfigSources& sources, Side side) {
  return side == Side::active ? inspect<ActiveConfig>(sources, side) : inspect<PassiveConfig>(sources, side);
}

}  // namespace telehug
