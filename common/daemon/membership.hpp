// SPDX-License-Identifier: Apache-2.0
//
// Whom a daemon may speak to: the other PC of its pair or, without a pair, nobody beyond this PC.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "config/config.hpp"
#include "dds/settings.hpp"
#include "pairing/pairing.hpp"

namespace telehug {

struct Membership {
  DdsSettings dds;
  std::optional<Pair> pair;
};

// The configured pair, checked, or the only one there is. An error lists what is wrong with it: a daemon whose pair
// is broken must not run as if it had none.
[[nodiscard]] Result<Membership> membership(const PeerConfig& config, Side side, WallTime now);

// What a running daemon must not overlook: DDS Security looks at certificates only when two sides meet. The reason why
// the pair is over, one sentence; nothing while it holds.
[[nodiscard]] std::optional<std::string> pair_over(const Membership& membership, WallTime now);

// For the status, as the pair is now: it may have been renewed.
[[nodiscard]] nlohmann::json pair_json(const Pair& pair);
// A problem if the pair ends within two weeks: it should have been renewed long before.
[[nodiscard]] std::optional<nlohmann::json> pair_end_problem(const Membership& membership, WallTime now);

// One line for the log.
[[nodiscard]] std::string describe(const Membership& membership);

}  // namespace telehug
