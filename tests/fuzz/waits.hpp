// SPDX-License-Identifier: Apache-2.0
//
// For fuzzers that wait in the kernel: libFuzzer's alarm, by which it notices inputs that take too long, would end each
// wait with an error.
#pragma once

#include <csignal>

namespace telehug {

inline void let_waits_go_on() {
  struct sigaction alarm {};
  ::sigaction(SIGALRM, nullptr, &alarm);
  alarm.sa_flags |= SA_RESTART;
  ::sigaction(SIGALRM, &alarm, nullptr);
}

}  // namespace telehug
