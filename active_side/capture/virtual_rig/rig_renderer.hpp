// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <optional>

#include "capture/virtual_rig/development.hpp"
#include "capture/virtual_rig/hand.hpp"
#include "capture/virtual_rig/mirror_blur.hpp"
#include "capture/virtual_rig/pinhole_camera.hpp"
#include "capture/virtual_rig/rig_scene.hpp"
#include "capture/virtual_rig/settings.hpp"

namespace telehug {

// Draws the pictures of a virtual rig: the scene is rendered once, a frame only adds the hand, its mirror image in the
// screen, and what lens and sensor do to them.
class RigRenderer {
 public:
  explicit RigRenderer(const VirtualRigSettings& settings);

  // Shows another picture on the screen (CV_8UC3; renders the scene anew, some 100 ms).
  void show(const cv::Mat& picture);

  // `finger` nullopt: nobody there. The same `noise_index` gives the same noise and exposure.
  void draw(const std::optional<FingerPlace>& finger, std::uint64_t noise_index, cv::Mat& bgr);

  [[nodiscard]] const PinholeCamera& camera() const noexcept { return camera_; }

 private:
  void draw_hand(const Hand& hand, bool mirrored, cv::Mat& layer, cv::Mat& height_mm);
  void draw_cone(const RoundCone& cone, bool mirrored, cv::Mat& layer, cv::Mat& height_mm);
  [[nodiscard]] cv::Rect box_of(const RoundCone& cone) const;

  VirtualRigSettings settings_;
  PinholeCamera camera_;
  RoomLighting lighting_;
  Development development_;
  MirrorBlur mirror_blur_;
  RigScene scene_;
  cv::Mat coded_scene_;
  cv::Mat coded_;
  cv::Mat nearest_t_;  // CV_32FC1: distance of what was drawn so far along each pixel's ray
};

}  // namespace telehug
