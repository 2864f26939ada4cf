// SPDX-License-Identifier: Apache-2.0
#include "face/inner_change.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace telehug {
namespace {

constexpr double moved_share = 0.03;  // of the box' height: more than a finder's noise in a still picture
constexpr int least_difference = 4;
constexpr double least_share = 0.02;
constexpr int green = 1;

bool same_place(const cv::Rect2d& a, const cv::Rect2d& b) {
  const double most = moved_share * a.height;
  return std::abs(a.x - b.x) <= most && std::abs(a.y - b.y) <= most && std::abs(a.height - b.height) <= most;
}

}  // namespace

bool InnerChange::look(const cv::Mat& picture, const cv::Rect2d& box) {
  const bool comparable = box_.height > 0 && same_place(box_, box);
  if (!comparable) box_ = box;
  int different = 0;
  for (std::size_t i = 0; i < seen_.size(); ++i) {
    const double across = (static_cast<double>(i % side) + 0.5) / side;
    const double down = (static_cast<double>(i / side) + 0.5) / side;
    const int x = std::clamp(cvFloor(box_.x + across * box_.width), 0, picture.cols - 1);
    const int y = std::clamp(cvFloor(box_.y + down * box_.height), 0, picture.rows - 1);
    const std::uint8_t now = picture.ptr<std::uint8_t>(y)[x * picture.channels() + green];
    const int before = std::exchange(seen_[i], now);
    if (std::abs(now - before) > least_difference) ++different;
  }
  return comparable && different >= least_share * static_cast<double>(seen_.size());
}

}  // namespace telehug
