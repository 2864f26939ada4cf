// SPDX-License-Identifier: Apache-2.0
//
// What is below the firmware's session.cpp, on the host: motors, heaters and the serial line's output. Ends the program
// when the session asks for what the microcontroller's own motors and heaters rely on never being asked.
#pragma once

#include <cstdint>
#include <vector>

namespace telehug::firmware_board {

// As after a reset: not armed, nothing written, room for every answer.
void reset();

// The keepalive was lost.
void disarm();

// The ring of the line has room for so many bytes from now on; one more are dropped as a whole answer.
void set_room(std::uint8_t bytes);

// What the session has written since the last call.
std::vector<std::uint8_t> take_written();

}  // namespace telehug::firmware_board
