// SPDX-License-Identifier: Apache-2.0
#include "calibration/whiteness.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace telehug {

float value_at(const cv::Mat& map, double column, double row) noexcept {
  const double x = std::clamp(column, 0.0, map.cols - 1.0);
  const double y = std::clamp(row, 0.0, map.rows - 1.0);
  const int x0 = std::min(static_cast<int>(x), std::max(0, map.cols - 2));
  const int y0 = std::min(static_cast<int>(y), std::max(0, map.rows - 2));
  const auto fx = static_cast<float>(x - x0);
  const auto fy = static_cast<float>(y - y0);
  const auto* const above = map.ptr<float>(y0);
  const auto* const below = map.ptr<float>(std::min(y0 + 1, map.rows - 1));
  const int x1 = std::min(x0 + 1, map.cols - 1);
  return (1 - fy) * ((1 - fx) * above[x0] + fx * above[x1]) + fy * ((1 - fx) * below[x0] + fx * below[x1]);
}

double Whiteness::blur_px(ImageSize image) noexcept {
  return 0.8 * picture_scale(image);
}

Whiteness::Whiteness(const cv::Mat& bgr, const cv::Rect& part) : part_(part & cv::Rect(0, 0, bgr.cols, bgr.rows)) {
  if (part_.empty()) return;
  map_.create(part_.size(), CV_32FC1);
  for (int row = 0; row < part_.height; ++row) {
    const auto* const from = bgr.ptr<cv::Vec3b>(part_.y + row) + part_.x;
    auto* const to = map_.ptr<float>(row);
    for (int column = 0; column < part_.width; ++column) {
      const auto [least, most] = std::minmax({from[column][0], from[column][1], from[column][2]});
      to[column] = static_cast<float>(least) - 0.5F * static_cast<float>(most - least);
    }
  }
  const double blur = blur_px({bgr.cols, bgr.rows});
  cv::GaussianBlur(map_, map_, {}, std::max(0.3, blur), 0, cv::BORDER_REPLICATE);

  std::vector<float> sorted(map_.begin<float>(), map_.end<float>());
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  dark_ = *middle;
  const double scale = picture_scale({bgr.cols, bgr.rows});
  const auto half_a_dot = static_cast<std::size_t>(std::max(4.0, 60 * scale * scale));
  const auto white = sorted.end() - static_cast<std::ptrdiff_t>(std::min(half_a_dot, sorted.size()));
  std::nth_element(sorted.begin(), white, sorted.end());
  contrast_ = *white - dark_;
}

float Whiteness::at(const ImagePoint& at) const noexcept {
  if (map_.empty()) return 0;
  return value_at(map_, at.u_px - part_.x, at.v_px - part_.y);
}

bool Whiteness::contains(const ImagePoint& at) const noexcept {
  return at.u_px >= part_.x && at.v_px >= part_.y && at.u_px <= part_.x + part_.width - 1 &&
         at.v_px <= part_.y + part_.height - 1;
}

}  // namespace telehug
