// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/clock.hpp"
#include "daemon/membership.hpp"
#include "service/log.hpp"

namespace telehug {

// Notices that pairs were made or revoked on this PC while a daemon runs.
class PairsWatch {
 public:
  PairsWatch(PeerConfig config, Side side, const Clock& clock);

  // At most once a second it looks, and once after each change it says which memberships there are now. Nothing, and a
  // warning in the log, if they can't be used.
  [[nodiscard]] std::optional<std::vector<Membership>> changed(WallTime now);
  // They could not all be used, because of this: tell of them again, with the next look.
  void look_again(const std::string& problem);

 private:
  [[nodiscard]] std::vector<std::string> ids() const;  // throws as PairStore does

  PeerConfig config_;
  Side side_;
  const Clock& clock_;
  Timestamp looked_at_;
  std::optional<std::vector<std::string>> seen_;
  SayOnChange say_;
};

}  // namespace telehug
