// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "capture/frame_source.hpp"
#include "common/result.hpp"
#include "setup/calibrated_rig.hpp"

namespace telehug {

struct HandCalibration {
  ScreenSize screen;                // mm; pixels, if known
  std::string model = "default";    // or "thesis"
  std::vector<ScreenPoint> points;  // two (default: or more), or none: those below
};

// "X,Y" each, in mm.
Result<std::vector<ScreenPoint>> parse_points(const std::vector<std::string>& texts);

// The thesis' points: the screen's middle at a third of its height, and 30 mm to the right of it farther down (100 and
// 220 mm on a screen of 300 mm).
[[nodiscard]] std::vector<ScreenPoint> thesis_points(const ScreenSize& screen);

// Five that lie far to the left and right, where the camera sees them.
[[nodiscard]] std::vector<ScreenPoint> default_points(const ScreenSize& screen);

// Leads a person through it: `instructions` get what to do, and a line from `answers` says that it is done. Pictures to
// show on the whole screen (written to the folder telehug-calibration in the current one): a triangle, a black one and,
// for the default model, one of marks, hands away, then a dot to touch for each point. With the default model a touch
// that does not fit is asked for once more.
Result<CalibratedRig> calibrate_by_hand(FrameSource& camera, const HandCalibration& wanted, const std::string& date,
                                        std::istream& answers, std::ostream& instructions);

}  // namespace telehug
