// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core/mat.hpp>

namespace telehug {

// Does what is shown inside a rectangle change from look to look? A still picture that is dragged over the screen does
// not count as changing: a look in which the rectangle has moved only says where to look next time.
class InnerChange {
 public:
  // `picture`: CV_8UC3 or CV_8UC4; `box` in its pixels, may reach past its edges. True if at least 2 % of 24 x 24
  // places inside differ from the last look by more than 4 of 255, more than dithering does.
  bool look(const cv::Mat& picture, const cv::Rect2d& box);

 private:
  static constexpr int side = 24;
  cv::Rect2d box_;
  std::array<std::uint8_t, static_cast<std::size_t>(side) * side> seen_{};
};

}  // namespace telehug
