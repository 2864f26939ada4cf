// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "capture/virtual_rig/pinhole_camera.hpp"
#include "capture/virtual_rig/touch_script.hpp"
#include "common/units.hpp"

namespace telehug {

// Everything that the pictures of a virtual rig follow from: two rigs with the same settings give the same pictures.
struct VirtualRigSettings {
  ScreenSize screen{380, 300, 1280, 1024};
  double bezel_mm = 20;          // width of the frame around the picture
  double bezel_raised_mm = 4.5;  // how far its lower part stands out in front of the screen
  double desk_below_mm = 90;     // from the screen's lower edge to the desk
  ImageSize image{1280, 720};
  double focal_px = 1100;
  CameraPose camera{{190, -15, 50}};  // above the middle of the screen's upper edge, looking straight down
  int skin_tone = 2;                  // Fitzpatrick 1 (I) to 6 (VI)
  double mirror = 0.08;               // share of light that the screen's coat reflects, 0 (matt) to 1
  double noise_sd = 3;                // of the sensor, in grey levels
  std::uint64_t seed = 1;             // of the noise
  double fps = 30;
  bool real_time = true;   // false: as fast as it is read
  bool repeat = true;      // play the script again and again; false: end after it
  cv::Mat screen_picture;  // CV_8UC3, shown over the whole screen; empty: a dark gradient
  TouchScript script;      // empty: default_script(screen)
};

}  // namespace telehug
