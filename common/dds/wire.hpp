// SPDX-License-Identifier: Apache-2.0
//
// Messages to and from the types that fastddsgen makes of idl/telehug.idl. Only for this room and its tests.
#pragma once

#include <telehug.h>

#include "common/messages.hpp"
#include "dds/validate.hpp"

namespace telehug {

// Both forms of a message are reused from one message to the next, so that steady traffic allocates nothing here.
// The message must be valid; texts that are too long are cut between two characters.
void to_wire(const TouchEvent& event, v1::TouchEvent& wire);
void to_wire(const Felt& felt, v1::Felt& wire);
void to_wire(const Heartbeat& heartbeat, v1::Heartbeat& wire);
void to_wire(const SideStatus& status, v1::SideStatus& wire);
void to_wire(const StopAll& stop, v1::StopAll& wire);
void to_wire(const PairRenewal& renewal, v1::PairRenewal& wire);
void to_wire(const Hug& hug, v1::Hug& wire);

// Checks the bounds and ends with validate(). The message is usable only if the answer is null.
[[nodiscard]] Fault from_wire(const v1::TouchEvent& wire, TouchEvent& event);
[[nodiscard]] Fault from_wire(const v1::Felt& wire, Felt& felt);
[[nodiscard]] Fault from_wire(const v1::Heartbeat& wire, Heartbeat& heartbeat);
[[nodiscard]] Fault from_wire(const v1::SideStatus& wire, SideStatus& status);
[[nodiscard]] Fault from_wire(const v1::StopAll& wire, StopAll& stop);
[[nodiscard]] Fault from_wire(const v1::PairRenewal& wire, PairRenewal& renewal);
[[nodiscard]] Fault from_wire(const v1::Hug& wire, Hug& hug);

}  // namespace telehug
