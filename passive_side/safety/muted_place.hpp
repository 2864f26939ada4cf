// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/messages.hpp"
#include "safety/consent.hpp"

namespace telehug {

// Is a touch there one that the wearer has muted? Its box counts, and the box that its place on the body lies in, so
// that a sender with a grid of another shape, or one that names another box, gets past neither.
[[nodiscard]] bool is_muted(const Contact& contact, const MutedBoxes& muted);

}  // namespace telehug
