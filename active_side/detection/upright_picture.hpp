// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>

#include "common/units.hpp"

namespace telehug {

// The pictures of a camera that delivers them upside down, turned as upright() in calibration/calibration.hpp thinks
// of them: the screen lies below its border.
class UprightPicture {
 public:
  UprightPicture(ImageSize image, bool upside_down) {
    if (upside_down) flipped_.create(image.height_px, image.width_px, CV_8UC3);
  }

  // The picture itself if it is upright, or of another size. Valid until the next call, and as long as `bgr` is.
  // Allocates nothing.
  const cv::Mat& of(const cv::Mat& bgr) {
    constexpr int about_the_middle_row = 0;
    if (bgr.size() != flipped_.size() || bgr.type() != flipped_.type()) return bgr;
    cv::flip(bgr, flipped_, about_the_middle_row);
    return flipped_;
  }

 private:
  cv::Mat flipped_;
};

}  // namespace telehug
