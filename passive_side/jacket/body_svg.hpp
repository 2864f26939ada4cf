// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "jacket/jacket_profile.hpp"

namespace telehug {

// The wearer as the toucher sees them, front and back side by side, as a complete SVG document: every actuator at its
// place with id and name; those in `running` filled, those that are switched off crossed out, heaters square. For pages
// that make more of it: each actuator's group has its id as data-actuator, each body's has data-side and data-grid, the
// place of the first five rows of boxes (x y width height).
[[nodiscard]] std::string body_svg(const JacketProfile& profile, std::span<const std::uint8_t> running);

}  // namespace telehug
