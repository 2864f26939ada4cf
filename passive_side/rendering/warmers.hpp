// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/messages.hpp"
#include "jacket/jacket_profile.hpp"
#include "rendering/spot.hpp"

namespace telehug {

// The heaters that a hand which rests at this contact's place may warm, each the more the nearer it is. A hug goes
// around the body: it warms the back, too. Where the rendering is by boxes: the heaters that serve the contact's box.
// Allocates nothing.
[[nodiscard]] Spot heaters_near(const Contact& contact, const JacketProfile& profile);

}  // namespace telehug
