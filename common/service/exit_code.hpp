// SPDX-License-Identifier: Apache-2.0
//
// How every telehug program ends. Scripts rely on these numbers: add, never change.
#pragma once

namespace telehug {

enum class ExitCode : int {
  ok = 0,
  internal = 1,          // a fault of telehug itself
  usage = 2,             // the command line can't be understood
  config = 3,            // the configuration has faults
  device = 4,            // a camera, screen, jacket or recording that was asked for can't be used
  not_running = 5,       // no daemon answers on the local socket
  peer_absent = 6,       // the other side isn't connected (only where a command asks for it)
  permission = 7,        // the local socket, or the service's pairs, may not be used by this user
  bad_answer = 8,        // the daemon did not answer in time, or not in its language
  refused = 9,           // the daemon understood and refused, or the user when asked
  already_running = 10,  // another daemon serves the same socket
  stopped = 11,          // stop is latched, or the wearer has paused (only where a command asks for it)
  fault = 12,            // a side reports that it can't work (only where a command asks for it)
  network = 13,          // DDS can't be set up on this PC
  mismatch = 14,         // a demo or comparison ran, and what came out is not what should have
  pair_ended = 15,       // the pair was revoked or has expired, or is not valid yet
};

[[nodiscard]] constexpr int to_int(ExitCode code) noexcept {
  return static_cast<int>(code);
}

}  // namespace telehug
