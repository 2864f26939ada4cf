// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <utility>

#include "common/clock.hpp"
#include "link/protocol.hpp"
#include "subscribe/sender_number.hpp"

namespace telehug {

// The microcontroller turns a motor or heater off by itself after at most this long.
inline constexpr Duration longest_command = std::chrono::milliseconds(protocol::drive_max_ms);

// Until when each sender's last heartbeat vouches for what it asks.
using Vouched = std::array<Timestamp, max_senders>;

// What one sender asks of one actuator.
struct Share {
  double level = 0;  // intensity of a motor, set-point of a heater; 0: nothing
  Timestamp end;     // of its drive
};

// What all senders ask of one actuator. Senders are below max_senders.
class Shares {
 public:
  void ask(SenderNumber sender, Share share) { shares_[sender] = share; }
  Share drop(SenderNumber sender) { return std::exchange(shares_[sender], {}); }
  void clear() { shares_.fill({}); }

  [[nodiscard]] bool any() const noexcept {
    return std::ranges::any_of(shares_, [](const Share& share) { return share.level > 0; });
  }

  // Ends what has come to its end; true if something has.
  bool expire(Timestamp now) {
    bool ended = false;
    for (Share& share : shares_) {
      if (share.level <= 0 || share.end > now) continue;
      share = {};
      ended = true;
    }
    return ended;
  }

  // What the actuator is to do now: the strongest wish, until its end or as long as its own sender's heartbeat vouches
  // for, and for one command at the most.
  [[nodiscard]] Share strongest(Timestamp now, const Vouched& vouched) const {
    Share strongest;
    for (std::size_t sender = 0; sender < max_senders; ++sender) {
      const Share& share = shares_[sender];
      const Timestamp end = std::min({share.end, vouched[sender], now + longest_command});
      if (share.level <= 0 || end <= now) continue;
      const bool stronger = share.level > strongest.level;
      const bool longer = share.level == strongest.level && end > strongest.end;
      if (stronger || longer) strongest = {share.level, end};
    }
    return strongest;
  }

 private:
  std::array<Share, max_senders> shares_{};
};

}  // namespace telehug
