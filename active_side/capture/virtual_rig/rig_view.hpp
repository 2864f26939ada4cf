// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <opencv2/core/mat.hpp>

#include "capture/virtual_rig/development.hpp"
#include "capture/virtual_rig/hand_shadow.hpp"
#include "capture/virtual_rig/linear_light.hpp"
#include "capture/virtual_rig/mirror_blur.hpp"
#include "capture/virtual_rig/pinhole_camera.hpp"
#include "capture/virtual_rig/rig_scene.hpp"
#include "capture/virtual_rig/settings.hpp"

namespace telehug {

// All that stays the same from picture to picture while camera, light and the screen's picture do. Making one takes
// some 100 ms, drawing with it some.
struct RigView {
  PinholeCamera camera;
  RoomLighting lighting;
  RigScene scene;
  cv::Rect screen_box;  // the part of the picture where the screen is
  cv::Mat light;        // CV_16UC3: the scene with what the screen mirrors, before the lens, as root_coded() has it
  cv::Mat coded;        // the same after the lens (see Development)
  HandShadow shadow;
};

// With the settings' camera and light and `shown` (CV_8UC3) on the screen.
std::shared_ptr<RigView> make_view(const VirtualRigSettings& settings, const cv::Mat& shown, Development& development);

// The same with what the settings say that the screen shows.
std::shared_ptr<RigView> make_view(const VirtualRigSettings& settings, Development& development);

}  // namespace telehug
