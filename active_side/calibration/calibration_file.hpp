// SPDX-License-Identifier: Apache-2.0
//
// What a rig's calibration found, and its file. The file is TOML:
//
//   version = 1                          # of this layout
//   camera = "webcam /dev/v4l/by-id/..." # as FrameSource::name() says
//   date = "2026-11-22T05:30:00Z"
//   model = "thesis"
//   [image]                              # the camera's pictures, px
//   width_px = 1280
//   height_px = 720
//   [screen]                             # the visible area
//   width_mm = 380.0
//   height_mm = 300.0
//   width_px = 1280
//   height_px = 1024
//   [border]                             # image of the screen's bottom edge: v = v0_px + slope * u
//   v0_px = 512.5
//   slope = 0.004
//   [[touch]]                            # two of them; the first is the reference point
//   x_mm = 190.0
//   y_mm = 100.0
//   length_px = 118.0                    # finger past the border
//   column_px = -3.5                     # tip, signed, from the image centre
//
// The model is solved from the touches when the file is read, so that the file can't contradict itself.
#pragma once

#include <array>
#include <filesystem>
#include <string>

#include "calibration/border_line.hpp"
#include "calibration/thesis_touch_model.hpp"
#include "common/result.hpp"
#include "common/units.hpp"

namespace telehug {

// All that the active side needs to turn pictures of one camera into points on one screen.
struct Calibration {
  std::string camera;
  std::string date;  // ISO 8601, UTC
  ImageSize image;
  ScreenSize screen;  // its pixels are 0 if they are not known
  BorderLine border;
  std::array<MeasuredTouch, 2> touches;
  ThesisTouchModel model;  // solved from `screen` and `touches`
};

// The error holds every fault, one a line, each as "file:line: what is wrong"; or why the touches do not solve.
Result<Calibration> read_calibration(const std::filesystem::path& path);

// Makes the folder if need be. The file appears under its name when it is complete; an older one stays until then.
Status write_calibration(const std::filesystem::path& path, const Calibration& calibration);

}  // namespace telehug
