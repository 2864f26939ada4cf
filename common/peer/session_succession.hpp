// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

#include "common/messages.hpp"

namespace telehug {

// Which run of the peer's program is the present one. Session ids are random and carry no order, so the order is that
// of their first appearance: a session that was never seen before replaces the present one, and what still arrives from
// a replaced session (late packets of a program that was restarted) is refused.
class SessionSuccession {
 public:
  enum class Standing {
    current,    // of the present session
    successor,  // of a new session, which is the present one from now on
    retired,    // of a session that was replaced
  };

  Standing admit(const SessionId& session);

  // Empty before the first.
  [[nodiscard]] const SessionId& current() const noexcept { return current_; }

 private:
  static constexpr std::size_t remembered =
      16;  // replaced sessions; more restarts within one packet's life don't happen

  SessionId current_;
  std::array<SessionId, remembered> retired_;
  std::size_t next_retired_ = 0;
};

}  // namespace telehug
