// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>

#include "common/row_range.hpp"
#include "common/units.hpp"

namespace telehug {

// The pictures of a camera that delivers them upside down, turned as upright() in calibration/calibration.hpp thinks
// of them: the screen lies below its border.
class UprightPicture {
 public:
  UprightPicture(ImageSize image, bool upside_down) {
    if (upside_down) flipped_ = cv::Mat::zeros(image.height_px, image.width_px, CV_8UC3);
  }

  // The picture itself if it is upright, or of another size. Valid until the next call, and as long as `bgr` is.
  // Only `rows` of `bgr` need be right. Allocates nothing.
  const cv::Mat& of(cv::Mat&& bgr, RowRange rows = {}) = delete;
  const cv::Mat& of(const cv::Mat& bgr, RowRange rows = {}) {
    constexpr int about_the_middle_row = 0;
    if (bgr.size() != flipped_.size() || bgr.type() != flipped_.type()) return bgr;
    const RowRange from = rows.within(bgr.rows);
    const RowRange to = rows.flipped(bgr.rows);
    if (from.count() == 0) return flipped_;
    cv::Mat turned = flipped_.rowRange(to.first, to.end);
    cv::flip(bgr.rowRange(from.first, from.end), turned, about_the_middle_row);
    return flipped_;
  }

  // Where these rows of the camera's picture are in of().
  [[nodiscard]] RowRange rows_of(RowRange rows) const { return flipped_.empty() ? rows : rows.flipped(flipped_.rows); }

 private:
  cv::Mat flipped_;
};

}  // namespace telehug
