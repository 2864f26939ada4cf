// SPDX-License-Identifier: Apache-2.0
//
// The microcontroller's end of the protocol: bytes in, motors and heaters driven, answers out. The board `legacy` has
// legacy_session.cpp in place of session.cpp.
#pragma once

#include <stdint.h>

namespace session {

// Takes one byte of the line; acts and answers when it ends a frame.
void receive(uint8_t byte);

}  // namespace session
