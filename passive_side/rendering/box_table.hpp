// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/messages.hpp"
#include "jacket/jacket_profile.hpp"
#include "rendering/spot.hpp"

namespace telehug {

// Number in the standard grid of the box that a contact is in; 0: beside or above it, or nowhere. A grid of another
// shape, and a box outside its grid, is read through the place on the body.
[[nodiscard]] int standard_box(const Contact& contact);

// The motors that serve a contact's box, all alike; failing that, by the profile's rule, the one that is nearest.
// Allocates nothing.
[[nodiscard]] Spot motors_of_box(const Contact& contact, const JacketProfile& profile);

}  // namespace telehug
