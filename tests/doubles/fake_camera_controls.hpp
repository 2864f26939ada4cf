// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "doubles/fake_v4l2.hpp"

namespace telehug {

// What a usual USB webcam has, with every automatic on.
inline std::vector<FakeV4l2::Control> usual_controls() {
  const auto number = [](std::uint32_t id, const char* name, int least, int most, int normal) {
    FakeV4l2::Control control;
    control.id = id;
    control.name = name;
    control.minimum = least;
    control.maximum = most;
    control.default_value = control.value = normal;
    return control;
  };
  const auto ruled = [](FakeV4l2::Control control, std::uint32_t automatic, int free_at) {
    control.ruled_by = automatic;
    control.free_at = free_at;
    return control;
  };
  std::vector<FakeV4l2::Control> controls{
      number(V4L2_CID_BRIGHTNESS, "Brightness", -64, 64, 0),
      number(V4L2_CID_CONTRAST, "Contrast", 0, 64, 32),
      number(V4L2_CID_SATURATION, "Saturation", 0, 128, 64),
      number(V4L2_CID_AUTO_WHITE_BALANCE, "White Balance, Automatic", 0, 1, 1),
      number(V4L2_CID_GAIN, "Gain", 0, 100, 10),
      number(V4L2_CID_POWER_LINE_FREQUENCY, "Power Line Frequency", 0, 2, 2),
      ruled(number(V4L2_CID_WHITE_BALANCE_TEMPERATURE, "White Balance Temperature", 2800, 6500, 4000),
            V4L2_CID_AUTO_WHITE_BALANCE, 0),
      number(V4L2_CID_MIN_BUFFERS_FOR_CAPTURE, "Buffers", 1, 8, 2),
      number(V4L2_CID_EXPOSURE_AUTO, "Auto Exposure", 0, 3, V4L2_EXPOSURE_APERTURE_PRIORITY),
      ruled(number(V4L2_CID_EXPOSURE_ABSOLUTE, "Exposure Time, Absolute", 3, 2047, 250), V4L2_CID_EXPOSURE_AUTO,
            V4L2_EXPOSURE_MANUAL),
      number(V4L2_CID_EXPOSURE_AUTO_PRIORITY, "Exposure, Dynamic Framerate", 0, 1, 1),
      ruled(number(V4L2_CID_FOCUS_ABSOLUTE, "Focus, Absolute", 0, 255, 30), V4L2_CID_FOCUS_AUTO, 0),
      number(V4L2_CID_FOCUS_AUTO, "Focus, Automatic Continuous", 0, 1, 1),
  };
  controls[7].flags = V4L2_CTRL_FLAG_READ_ONLY;
  return controls;
}

}  // namespace telehug
