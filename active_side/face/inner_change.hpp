// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core/mat.hpp>

namespace telehug {

// Does what is shown inside a rectangle change from look to look, otherwise than by being moved? A still picture that
// is dragged or scrolled over the screen does not.
class InnerChange {
 public:
  // `picture`: CV_8UC3 or CV_8UC4; `box` in its pixels, may reach past its edges. True if the last look's samples, 24 x
  // 24 of them, are not found again within 3 % of the box' height of where it is and of where it was: at every such
  // place at least 2 % of them differ by more than 4 of 255, which is more than dithering does. False at the first
  // look, and after one in which the box had another size.
  bool look(const cv::Mat& picture, const cv::Rect2d& box);

 private:
  static constexpr int side = 24;

  [[nodiscard]] cv::Point sample_place(std::size_t index) const;
  [[nodiscard]] bool found_about(const cv::Mat& picture, const cv::Point& moved) const;

  cv::Rect2d box_;
  std::array<std::uint8_t, static_cast<std::size_t>(side) * side> seen_{};
};

}  // namespace telehug
