// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "service/signals.hpp"

namespace telehug {

// Before a daemon ends for what passes by itself: the units allow 30 starts within 5 minutes, after which systemd would
// start it no more. Waits 10 s if systemd has started it, unless it is told to stop.
void wait_before_restart(Signals& signals);

}  // namespace telehug
