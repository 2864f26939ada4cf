// SPDX-License-Identifier: Apache-2.0
#include "config/load.hpp"

#include <fmt/core.h>

#include <algorithm>

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

template <typename Config>
Result<Config> load(const ConfigSources& sources, Side side) {
  Config config;
  std::vector<Key> keys = keys_of(config);
  std::vector<Fault> faults;
  for (const auto& file : config_files(sources, side))
    read_toml_file(file, keys, faults);
  for (const auto& text : sources.overrides)
    apply_override(text, keys, faults);
  for (Fault& fault : impossible_combinations(config, keys))
    faults.push_back(std::move(fault));
  if (!faults.empty()) return Error{listing(faults)};
  return config;
}

}  // namespace

Result<ActiveConfig> load_active_config(const ConfigSources& sources) {
  return load<ActiveConfig>(sources, Side::active);
}

Result<PassiveConfig> load_passive_config(const ConfigSources& sources) {
  return load<PassiveConfig>(sources, Side::passive);
}

}  // namespace telehug
