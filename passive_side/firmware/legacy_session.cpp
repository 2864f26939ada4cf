// SPDX-License-Identifier: Apache-2.0
//
// What the thesis' sketch did: a byte 1..16 gives that motor a pulse at full power. No frames, no answers; other bytes
// mean nothing. A byte for a motor that runs begins its pulse anew.
#include "board.hpp"
#include "link/protocol.hpp"
#include "motors.hpp"
#include "session.hpp"

namespace session {

void receive(uint8_t byte) {
  constexpr uint8_t full = 255;
  if (byte == 0 || byte > board::motor_count) return;
  if (!motors::armed()) motors::arm();
  motors::host_lives();
  motors::begin_change();
  motors::set(byte - 1, full, telehug::protocol::drive_max_ms);
  motors::commit_change();
}

}  // namespace session
