// SPDX-License-Identifier: Apache-2.0
//
// Whom a daemon may speak to: the other PCs of its pairs or, without a pair, nobody beyond this PC.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "config/config.hpp"
#include "dds/settings.hpp"
#include "pairing/pairing.hpp"

namespace telehug {

struct Membership {
  DdsSettings dds;
  std::optional<Pair> pair;
};

// So many pairs one daemon serves: SafetyStage tells as many senders apart.
inline constexpr std::size_t max_memberships = 8;

struct Memberships {
  std::vector<Membership> members;    // none only if every pair fails by its date alone
  std::vector<std::string> left_out;  // what is wrong with each pair that can't be used, and what to do
};

// The configured pairs, checked. If none are configured: on the wearer's PC all there are (who was granted a pair may
// touch), on a parent's the only one there is (with several it must be said who is touched). Without any pair: one
// membership, of this PC alone. A pair that can't be used is left out as long as another can; if none can, that is the
// error, unless it is for their dates, which pass: a daemon whose pair is broken must not run as if it had none.
[[nodiscard]] Result<Memberships> memberships(const PeerConfig& config, Side side, WallTime now);

// Why there are no members: a line for each fault and what to do.
[[nodiscard]] std::string why_none(const Memberships& none);

// Of the same pair, or both of none.
[[nodiscard]] bool same_pair(const Membership& a, const Membership& b);

// What a running daemon must not overlook: DDS Security looks at certificates only when two sides meet. The reason why
// the pair is over, one sentence; nothing while it holds.
[[nodiscard]] std::optional<std::string> pair_over(const Membership& membership, WallTime now);

// For the status, as the pair is now: it may have been renewed.
[[nodiscard]] nlohmann::json pair_json(const Pair& pair);
// A problem if the pair ends within two weeks: it should have been renewed long before.
[[nodiscard]] std::optional<nlohmann::json> pair_end_problem(const Pair& pair, WallTime now);

// One line for the log.
[[nodiscard]] std::string describe(const Membership& membership);

}  // namespace telehug
