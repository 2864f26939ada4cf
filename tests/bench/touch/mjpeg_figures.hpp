// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "bench/touch/figure.hpp"
#include "bench/touch/touch_path.hpp"
#include "common/row_range.hpp"
#include "finger/finger_detector.hpp"

namespace telehug {

// From a webcam's MJPEG frame to touch points, beside the least that this could take: decoding the entropy coded data
// alone, and one pass over the bytes of the rows that are needed. `ratio` is the one by the other, of the medians.
Figures measure_mjpeg(FingerDetector& detector, RowRange rows, const TouchedRig& rig, const std::string& suffix);

}  // namespace telehug
