// SPDX-License-Identifier: Apache-2.0
#include "eval/calibration_touches.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace telehug {

Result<std::vector<const CalibrationTouch*>> calibration_touches(const RigDirectory& rig,
                                                                 const std::vector<int>& numbers) {
  std::vector<const CalibrationTouch*> touches;
  for (const int number : numbers) {
    const auto found = std::find_if(rig.calibration.begin(), rig.calibration.end(), [&](const CalibrationTouch& t) {
      int value = 0;
      const char* const end = t.frame.name.data() + t.frame.name.size();
      const auto parsed = std::from_chars(t.frame.name.data(), end, value);
      return parsed.ec == std::errc{} && parsed.ptr == end && value == number;
    });
    if (found == rig.calibration.end()) {
      return Error{fmt::format("{} has no calibration touch {}: see its calibration.csv", rig.path.string(), number)};
    }
    touches.push_back(&*found);
  }
  return touches;
}

}  // namespace telehug
