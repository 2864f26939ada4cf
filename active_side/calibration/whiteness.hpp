// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>
#include <opencv2/core/types.hpp>

#include "common/units.hpp"

namespace telehug {

// Lengths in px are meant for pictures 1280 px wide; for others they are multiplied by this.
[[nodiscard]] constexpr double picture_scale(ImageSize image) noexcept {
  return image.width_px / 1280.0;
}

// How white a part of a picture is: the least of the three colours minus half their difference, so that white light
// counts and lit skin counts little.
class Whiteness {
 public:
  // `part` is cut to the picture; `bgr` is CV_8UC3.
  Whiteness(const cv::Mat& bgr, const cv::Rect& part);

  // Between pixels, in grey levels; `at` is in the picture's coordinates, outside the part its edge goes on.
  [[nodiscard]] float at(const ImagePoint& at) const noexcept;
  [[nodiscard]] bool contains(const ImagePoint& at) const noexcept;
  // More than a third of the way from dark to white.
  [[nodiscard]] bool is_white(const ImagePoint& point) const noexcept { return at(point) > dark_ + 0.35F * contrast_; }
  // What most of the part is.
  [[nodiscard]] float dark() const noexcept { return dark_; }
  // What as many pixels as half of a small dot are above that, at least.
  [[nodiscard]] float contrast() const noexcept { return contrast_; }
  [[nodiscard]] int top_px() const noexcept { return part_.y; }
  [[nodiscard]] const cv::Rect& part() const noexcept { return part_; }
  // Standard deviation of the blur that this adds to the picture's own.
  [[nodiscard]] static double blur_px(ImageSize image) noexcept;

 private:
  cv::Rect part_;
  cv::Mat map_;  // CV_32FC1
  float dark_ = 0;
  float contrast_ = 0;
};

// The value of a CV_32FC1 picture between its pixels; its edge goes on outside.
[[nodiscard]] float value_at(const cv::Mat& map, double column, double row) noexcept;

}  // namespace telehug
