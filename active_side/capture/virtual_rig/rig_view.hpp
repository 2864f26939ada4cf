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
#include "capture/virtual_rig/shown_picture.hpp"

namespace telehug {

// All that stays the same from picture to picture while camera, light and the screen's picture do. Making one takes
// some 100 ms, with another's scene some 10.
struct RigView {
  PinholeCamera camera;
  RoomLighting lighting;
  VirtualRigSettings settings;
  std::shared_ptr<const RigScene> scene;
  ShownPicture shown;
  cv::Rect screen_box;  // the part of the picture where the screen is
  cv::Rect window_box;  // and where its picture moves
  cv::Mat light;        // CV_16UC3: the scene with what the screen mirrors, before the lens, as root_coded() has it
  cv::Mat coded;        // the same after the lens (see Development)
  HandShadow shadow;
};

// With the settings' camera and light and `shown` (CV_8UC3) on the screen. The scene is that of `other` if it is the
// same and given.
std::shared_ptr<RigView> make_view(const VirtualRigSettings& settings, const cv::Mat& shown, Development& development,
                                   const std::shared_ptr<RigView>& other = nullptr);

// The same with what the settings say that the screen shows.
std::shared_ptr<RigView> make_view(const VirtualRigSettings& settings, Development& development,
                                   const std::shared_ptr<RigView>& other = nullptr);

// Develops a box of the view again, after what the screen shows there has changed.
void develop(RigView& view, const cv::Rect& box, Development& development);

}  // namespace telehug
