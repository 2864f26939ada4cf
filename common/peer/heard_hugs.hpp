// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "common/clock.hpp"
#include "common/messages.hpp"
#include "peer/path_delay.hpp"

namespace telehug {

// Which of the hugs that arrive are shown: each once, none that is late, none of anybody but the peer that is heard.
// Not for use by several threads at a time.
class HeardHugs {
 public:
  // A hug is for the moment; what was sent again so long after it may have been recorded.
  static constexpr Duration latest = 3s;

  // Each heartbeat of the peer that counted (PeerMonitor), when it came.
  void observe(const Heartbeat& peer, Timestamp now);

  // Is a hug that came then to be shown?
  [[nodiscard]] bool shows(const Hug& hug, Timestamp arrived);

 private:
  SessionId session_;
  std::uint64_t last_sequence_ = 0;
  PathDelay path_;
};

}  // namespace telehug
