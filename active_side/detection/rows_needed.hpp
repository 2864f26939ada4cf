// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "calibration/calibration.hpp"
#include "common/row_range.hpp"
#include "common/units.hpp"

namespace telehug {

// The rows of upright pictures in which a detector looks for fingers: from some way in front of the screen's
// bottom edge, where a finger comes from, over all of the screen. `px_per_mm`: of the picture at that edge.
[[nodiscard]] RowRange rows_needed(const BorderCurve& border, ImageSize image, double px_per_mm);

// The same in pictures as the calibration's camera delivers them, be it upside down.
[[nodiscard]] RowRange rows_needed(const Calibration& calibration);

}  // namespace telehug
