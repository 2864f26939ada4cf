// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "bench/rendering/accuracy.hpp"

namespace telehug {

// An SVG of the body's front as the toucher sees it: the boxes, the motors with their ids, and for every touch a line
// from its place to where it is felt.
[[nodiscard]] std::string accuracy_picture(const JacketProfile& profile, const std::vector<FeltPlace>& places,
                                           const std::string& title, const std::string& figures);

}  // namespace telehug
