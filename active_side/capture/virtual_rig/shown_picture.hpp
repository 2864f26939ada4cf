// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>

#include "capture/virtual_rig/linear_light.hpp"
#include "capture/virtual_rig/settings.hpp"

namespace telehug {

// The light of what is on the screen. A part of it, the window, may move like a video.
class ShownPicture {
 public:
  // `shown` (CV_8UC3, any size) is stretched over the screen.
  ShownPicture(const VirtualRigSettings& settings, const cv::Mat& shown);

  // At a place of the screen, as the camera sees it.
  [[nodiscard]] Light at(float x_mm, float y_mm) const;

  // What falls onto fingers before it: the mean over some 30 mm.
  [[nodiscard]] Light around(float x_mm, float y_mm) const;

  // Shows what is in the window at that time. False: it looks as before.
  bool move_to(double time_s);

  // In mm; empty if nothing moves.
  [[nodiscard]] const cv::Rect2f& window() const noexcept { return window_; }

 private:
  [[nodiscard]] Light still_at(float x_mm, float y_mm) const;
  [[nodiscard]] Light in_window(float x_mm, float y_mm) const;
  void light_surroundings();

  ScreenMotion motion_;
  cv::Mat light_;         // CV_32FC3, a pixel each 0.5 mm
  cv::Mat still_around_;  // CV_32FC3, a pixel each 10 mm
  cv::Mat around_;
  cv::Rect2f window_;
  int picture_ = 0;  // of the window's video
  float time_s_ = 0;
};

}  // namespace telehug
