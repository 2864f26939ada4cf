// SPDX-License-Identifier: Apache-2.0
//
// Is a solved calibration good enough to be saved, and if not, what should the person do?
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "calibration/calibration.hpp"

namespace telehug {

struct CalibrationLimits {
  double touch_rms_mm = 5;           // of the touches that were used; a finger's pad is about 10 mm wide
  double border_rms_px = 2;          // a lens bends the border smoothly: more is another edge
  double parameter_sd = 4;           // distance from what is usual; more is no webcam on top of a monitor
  double predicted_vertical_mm = 4;  // mean standard deviation over what the camera sees
  double predicted_horizontal_mm = 4;
  double same_dot_mm = 15;  // a touch this near to another dot is taken for one of that dot
};

struct CalibrationVerdict {
  std::vector<std::string> faults;                               // why it must not be saved; empty: it may be
  std::vector<std::string> advice;                               // what to do about it, or to make a good one better
  std::optional<std::size_t> repeat;                             // index of the touch to take again first
  std::optional<std::size_t> looks_like;                         // index of the dot where that touch seems to be
  std::optional<std::pair<std::size_t, std::size_t>> exchanged;  // two touches that seem to be in the wrong order

  [[nodiscard]] bool good() const noexcept { return faults.empty(); }
};

// `dots`: all points the person was asked to touch, in order; the touches are those of the first of them, or all: then
// they need not be named. Texts number touches and dots from 1.
[[nodiscard]] CalibrationVerdict judge_calibration(const RigCalibration& calibration);
[[nodiscard]] CalibrationVerdict judge_calibration(const RigCalibration& calibration,
                                                   const std::vector<ScreenPoint>& dots,
                                                   const CalibrationLimits& limits = {});

}  // namespace telehug
