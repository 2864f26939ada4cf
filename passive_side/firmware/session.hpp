// SPDX-License-Identifier: Apache-2.0
//
// The microcontroller's end of the protocol: bytes in, motors driven, answers out.
#pragma once

#include <stdint.h>

namespace session {

// Takes one byte of the line; acts and answers when it ends a frame.
void receive(uint8_t byte);

}  // namespace session
