// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>

#include "capture/virtual_rig/pinhole_camera.hpp"
#include "capture/virtual_rig/settings.hpp"

namespace telehug {

// What the camera sees while nobody is there: screen, bezel, monitor foot, desk. Without lens blur and noise.
struct RigScene {
  cv::Mat picture;     // CV_8UC3
  cv::Mat unmirrored;  // the same without what the screen's coat reflects
  cv::Mat is_screen;   // CV_8UC1: 255 where the pixel looks at the screen
};

// `shown` is on the screen (CV_8UC3, any size, stretched over it).
RigScene render_scene(const VirtualRigSettings& settings, const PinholeCamera& camera, const cv::Mat& shown);

}  // namespace telehug
