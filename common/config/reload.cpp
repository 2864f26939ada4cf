// SPDX-License-Identifier: Apache-2.0
#include "config/reload.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "config/key.hpp"

namespace telehug {
namespace {

void take_over(const Target& to, const Target& from) {
  std::visit([&from](auto* value) { *value = *std::get<decltype(value)>(from); }, to);
}

template <typename Config>
Result<Reloaded<Config>> merge(const Config& used, Config read, const LiveKeys& live) {
  Reloaded<Config> result{used, {}};
  std::vector<Key> keys = keys_of(result.config);
  const std::vector<Key> read_keys = keys_of(read);
  for (std::size_t i = 0; i < keys.size(); ++i) {
    KeyChange change{keys[i].path(), toml_text(keys[i].target), toml_text(read_keys[i].target), false};
    if (change.before == change.after) continue;
    change.now = is_live(change.path, live);
    if (change.now) take_over(keys[i].target, read_keys[i].target);
    result.changes.push_back(std::move(change));
  }
  std::string problems;
  for (const Fault& fault : impossible_combinations(result.config, keys))
    problems += fmt::format("{}without a restart: {}", problems.empty() ? "" : "\n", fault.what);
  if (!problems.empty()) return Error{problems};
  return result;
}

}  // namespace

const LiveKeys& live_keys(Side side) {
  static const LiveKeys active{"touch.", "body_map.", "hug.", "log.level"};
  static const LiveKeys passive{"consent.quiet_hours", "log.level"};
  return side == Side::active ? active : passive;
}

bool is_live(std::string_view path, const LiveKeys& live) {
  return std::ranges::any_of(
      live, [&](std::string_view key) { return key == path || (key.ends_with('.') && path.starts_with(key)); });
}

Result<Reloaded<ActiveConfig>> reloaded(const ActiveConfig& used, const ActiveConfig& read, const LiveKeys& live) {
  return merge(used, read, live);
}

Result<Reloaded<PassiveConfig>> reloaded(const PassiveConfig& used, const PassiveConfig& read, const LiveKeys& live) {
  return merge(used, read, live);
}

}  // namespace telehug
