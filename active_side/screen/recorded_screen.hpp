// SPDX-License-Identifier: Apache-2.0
//
// The part of a recording (capture/rig_directory.hpp) that holds what the screen showed:
//
//   screen/NAME.jpg     pictures of the screen, or of the part of it that was looked at
//   screen_times.csv    frame,monotonic_ns: from when on each was shown, rising; in the camera's time (times.csv).
//                       x_px,y_px,monitor_width_px,monitor_height_px: where on the monitor the picture's top-left
//                       corner lies; may be left out or empty if the picture is the whole monitor
#pragma once

#include <filesystem>
#include <opencv2/core/types.hpp>
#include <optional>
#include <vector>

#include "common/clock.hpp"
#include "common/result.hpp"
#include "common/units.hpp"

namespace telehug {

struct RecordedScreenPicture {
  std::filesystem::path file;
  Duration shown_after{};            // from the first picture
  cv::Point origin_px;               // of its top-left corner; within the monitor
  std::optional<ImageSize> monitor;  // none: the picture is the whole monitor
};

// Reads everything but the pictures, in order of time; there is one at least. Pictures without a line are left out. The
// error tells all faults at once, one a line, each as "file:line: what".
Result<std::vector<RecordedScreenPicture>> read_recorded_screen(const std::filesystem::path& recording);

}  // namespace telehug
