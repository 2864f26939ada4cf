// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "capture/frame_source.hpp"
#include "common/clock.hpp"
#include "common/result.hpp"
#include "setup/calibrated_rig.hpp"

namespace telehug {

struct HandCalibration {
  ScreenSize screen;                // mm; pixels, if known
  std::string model = "default";    // or "thesis", which has two dots
  std::vector<ScreenPoint> points;  // two (default: or more), or none: planned where the camera sees them
  bool two_dots = false;            // instead of nine
};

// "X,Y" each, in mm.
Result<std::vector<ScreenPoint>> parse_points(const std::vector<std::string>& texts);

// Leads a person through a CalibrationSession: `instructions` get what to show and to do. Pictures to show on the whole
// screen are written to the folder telehug-calibration in the current one: a triangle, a black one and, for the default
// model, one of marks, hands away, then a dot to touch each. Nothing is to be typed: what is shown is seen by the
// camera, and a touch is taken, with a beep, when the finger rests. With the default model a touch that does not fit is
// asked for once more.
Result<CalibratedRig> calibrate_by_hand(FrameSource& camera, const HandCalibration& wanted, const std::string& date,
                                        const Clock& clock, std::ostream& instructions);

}  // namespace telehug
