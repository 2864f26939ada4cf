// SPDX-License-Identifier: Apache-2.0
//
// A configuration that is read anew while a daemon runs: what may change then, changes; all else is named.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "common/messages.hpp"
#include "common/result.hpp"
#include "config/config.hpp"

namespace telehug {

// One key whose value in the files is another than that in use.
struct KeyChange {
  std::string path;    // "touch.up_after_ms"
  std::string before;  // as written in a file
  std::string after;
  bool now = false;  // false: not before a restart, and `before` is still in use
};

template <typename Config>
struct Reloaded {
  Config config;  // to be used from now on
  std::vector<KeyChange> changes;
};

// "section.key", or "section." for all of a section.
using LiveKeys = std::vector<std::string_view>;

// What that side's daemon takes over without a restart. Of the wearer's limits, the jacket and who may touch nothing:
// these are weakened only while everything is off.
[[nodiscard]] const LiveKeys& live_keys(Side side);
[[nodiscard]] bool is_live(std::string_view path, const LiveKeys& live);

// What is used once `read` has come from the files: of it the live keys, of `used` all else. An error, "without a
// restart: sentence" a line, if these two do not go together; then `used` remains.
[[nodiscard]] Result<Reloaded<ActiveConfig>> reloaded(const ActiveConfig& used, const ActiveConfig& read,
                                                      const LiveKeys& live = live_keys(Side::active));
[[nodiscard]] Result<Reloaded<PassiveConfig>> reloaded(const PassiveConfig& used, const PassiveConfig& read,
                                                       const LiveKeys& live = live_keys(Side::passive));

}  // namespace telehug
