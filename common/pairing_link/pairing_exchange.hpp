// SPDX-License-Identifier: Apache-2.0
//
// One PC invites, the other dials; which of them is the parent's does not matter. SIGPIPE must be ignored (Signals does
// it). `stop_fd`: when it is readable, every wait ends; -1: none.
#pragma once

#include <chrono>

#include "common/result.hpp"
#include "pairing_link/pairing_code.hpp"
#include "pairing_link/pairing_dialogue.hpp"

namespace telehug {

struct ExchangeLimits {
  std::chrono::milliseconds invitation = std::chrono::minutes(10);
  std::chrono::milliseconds handshake = std::chrono::seconds(5);
  std::chrono::milliseconds idle = std::chrono::seconds(30);
  int wrong_handshakes = 5;  // as many, and the invitation is over: nobody guesses for ten minutes
};

// Good for one pairing. From the first PC that knows the code on, nobody else is listened to.
class Invitation {
 public:
  // Listens from here on; port 0: any free one. Throws std::runtime_error (a sentence).
  explicit Invitation(const Endpoint& at, const ExchangeLimits& limits = {});

  [[nodiscard]] const PairingCode& code() const noexcept { return code_; }

  [[nodiscard]] Status pair(const Offer& offer, int stop_fd);

 private:
  ExchangeLimits limits_;
  OwnedFd listener_;
  Deadline end_;
  PairingCode code_;
};

[[nodiscard]] Status accept_invitation(const PairingCode& code, const Offer& offer, const ExchangeLimits& limits,
                                       int stop_fd);

}  // namespace telehug
