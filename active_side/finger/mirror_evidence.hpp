// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "finger/mirror_state.hpp"

namespace telehug {

// What it is worth that the tip net gives these log odds of touching and this height; not a number: nothing.
[[nodiscard]] MirrorEvidence mirror_evidence(double touches_logit, double hover_mm);

}  // namespace telehug
