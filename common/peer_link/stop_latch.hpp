// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>

#include "common/messages.hpp"
#include "peer/session_succession.hpp"

namespace telehug {

// Has the peer stopped everything? A stop holds whoever says it, and outlives the program that said it: neither its end
// nor its restart turns anything on. Only a word of the peer's present session, newer than its last, lifts it.
class StopLatch {
 public:
  // One thread at a time.
  void heard(const StopAll& word) {
    const auto standing = sessions_.admit(word.session);
    const bool overtaken = standing == SessionSuccession::Standing::current && word.sequence <= last_sequence_;
    if (overtaken) return;
    if (standing != SessionSuccession::Standing::retired) last_sequence_ = word.sequence;
    if (word.stop) stopped_ = true;
    if (!word.stop && standing != SessionSuccession::Standing::retired) stopped_ = false;
  }

  // Any thread.
  [[nodiscard]] bool stopped() const noexcept { return stopped_; }

 private:
  SessionSuccession sessions_;
  std::uint64_t last_sequence_ = 0;
  std::atomic<bool> stopped_ = false;
};

}  // namespace telehug
