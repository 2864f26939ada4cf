// SPDX-License-Identifier: Apache-2.0
#include "daemon/wait_before_restart.hpp"

#include <cstdlib>

namespace telehug {

void wait_before_restart(Signals& signals) {
  if (std::getenv("NOTIFY_SOCKET") != nullptr) (void)signals.wait(10s);
}

}  // namespace telehug
