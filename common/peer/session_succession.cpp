// SPDX-License-Identifier: Apache-2.0
#include "peer/session_succession.hpp"

#include <algorithm>

namespace telehug {

SessionSuccession::Standing SessionSuccession::admit(const SessionId& session) {
  if (session == current_) return Standing::current;
  if (std::find(retired_.begin(), retired_.end(), session) != retired_.end()) return Standing::retired;
  retired_[next_retired_] = current_;
  next_retired_ = (next_retired_ + 1) % remembered;
  current_ = session;
  return Standing::successor;
}

}  // namespace telehug
