// SPDX-License-Identifier: Apache-2.0
#include "daemon/pairs_watch.hpp"

#include <utility>

#include "config/places.hpp"

namespace telehug {
namespace {

constexpr Duration interval = 1s;

}  // namespace

PairsWatch::PairsWatch(PeerConfig config, Side side, const Clock& clock)
    : config_(std::move(config)), side_(side), clock_(clock), looked_at_(clock.now()), seen_(ids()) {}

std::optional<std::vector<Membership>> PairsWatch::changed(WallTime now) {
  const Timestamp looking = clock_.now();
  if (looking - looked_at_ < interval) return {};
  looked_at_ = looking;
  try {
    auto present = ids();
    if (present == seen_) return {};
    seen_ = std::move(present);
    auto found = memberships(config_, side_, now);
    if (found && !found->members.empty()) return std::move(found->members);
    const std::string why = found ? why_none(*found) : found.error().message;
    say_.say(spdlog::level::warn, "the connections stay as they are: " + why, {.stage = "pairing"});
  } catch (const std::exception& problem) {
    say_.say(spdlog::level::warn, std::string("the pairs of this PC can't be read: ") + problem.what(),
             {.stage = "pairing"});
  }
  return {};
}

void PairsWatch::look_again(const std::string& problem) {
  say_.say(spdlog::level::warn, "a new pair can't be used yet: " + problem, {.stage = "pairing"});
  seen_.reset();
}

std::vector<std::string> PairsWatch::ids() const {
  std::vector<std::string> ids;
  for (const Pair& pair : PairStore(pairs_folder(config_, side_), side_).list())
    ids.push_back(pair.id);
  return ids;
}

}  // namespace telehug
