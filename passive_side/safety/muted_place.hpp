// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "common/messages.hpp"
#include "common/units.hpp"
#include "safety/consent.hpp"

namespace telehug {

// Is a touch there one that the wearer has muted? Its box counts, and the box that its place on the body lies in, so
// that a sender with a grid of another shape, or one that names another box, gets past neither.
[[nodiscard]] bool is_muted(const Contact& contact, const MutedBoxes& muted);

// Is an actuator at this place one that the wearer has muted, itself or by the box that it lies in? On the back it is
// the box that it lies behind.
[[nodiscard]] bool is_muted(std::uint8_t actuator, BodyPoint place, const Permission& permission);

}  // namespace telehug
