// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "capture/virtual_rig/hand.hpp"
#include "capture/virtual_rig/pinhole_camera.hpp"
#include "capture/virtual_rig/rig_scene.hpp"
#include "capture/virtual_rig/settings.hpp"

namespace telehug {

// Draws the pictures of a virtual rig: the scene is rendered once, a frame only adds the hand, its mirror image in the
// screen, the lens' blur and the sensor's noise.
class RigRenderer {
 public:
  explicit RigRenderer(const VirtualRigSettings& settings);

  // Shows another picture on the screen (CV_8UC3; renders the scene anew, some 100 ms).
  void show(const cv::Mat& picture);

  // `finger` nullopt: nobody there. The same `noise_index` gives the same noise.
  void draw(const std::optional<FingerPlace>& finger, std::uint64_t noise_index, cv::Mat& bgr);
  void draw_without_noise(const std::optional<FingerPlace>& finger, cv::Mat& bgr);

  [[nodiscard]] const PinholeCamera& camera() const noexcept { return camera_; }

 private:
  void draw_hand(const Hand& hand, bool mirrored);
  void draw_cone(const RoundCone& cone, bool mirrored);
  [[nodiscard]] cv::Rect box_of(const RoundCone& cone) const;
  void add_noise(std::uint64_t noise_index, cv::Mat& bgr) const;

  VirtualRigSettings settings_;
  PinholeCamera camera_;
  RigScene scene_;
  cv::Mat blurred_scene_;
  cv::Mat sharp_;      // the scene with the hand, valid within drawn_
  cv::Mat nearest_t_;  // CV_32FC1: distance of what was drawn so far along each pixel's ray
  cv::Rect drawn_;
  cv::Mat brighter_;  // noise to add and to subtract, larger than a frame by noise_shift_px
  cv::Mat darker_;
};

}  // namespace telehug
