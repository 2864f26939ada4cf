// SPDX-License-Identifier: Apache-2.0
#include "face/inner_change.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace telehug {
namespace {

constexpr double searched_share = 0.03;  // of the box' height: more than a finder's noise in a still picture
constexpr int most_searched_px = 24;
constexpr double same_height = 0.1;
constexpr int least_difference = 4;
constexpr double least_share = 0.02;
constexpr int green = 1;

// Beyond an edge: the edge's own.
std::uint8_t shade_at(const cv::Mat& picture, const cv::Point& place) {
  const int x = std::clamp(place.x, 0, picture.cols - 1);
  const int y = std::clamp(place.y, 0, picture.rows - 1);
  return picture.ptr<std::uint8_t>(y)[x * picture.channels() + green];
}

}  // namespace

cv::Point InnerChange::sample_place(std::size_t index) const {
  const std::size_t row = index / side;
  const double across = (static_cast<double>(index % side) + 0.5) / side;
  const double down = (static_cast<double>(row) + 0.5) / side;
  return {cvFloor(box_.x + across * box_.width), cvFloor(box_.y + down * box_.height)};
}

bool InnerChange::found_about(const cv::Mat& picture, const cv::Point& moved) const {
  const int reach_px = std::clamp(cvCeil(searched_share * box_.height), 1, most_searched_px);
  const auto most_different = static_cast<int>(least_share * static_cast<double>(seen_.size()));
  for (int dy = -reach_px; dy <= reach_px; ++dy) {
    for (int dx = -reach_px; dx <= reach_px; ++dx) {
      int different = 0;
      for (std::size_t i = 0; i < seen_.size() && different <= most_different; ++i) {
        const int now = shade_at(picture, sample_place(i) + moved + cv::Point(dx, dy));
        if (std::abs(now - seen_[i]) > least_difference) ++different;
      }
      if (different <= most_different) return true;
    }
  }
  return false;
}

bool InnerChange::look(const cv::Mat& picture, const cv::Rect2d& box) {
  const bool comparable = box_.height > 0 && std::abs(box.height - box_.height) <= same_height * box_.height;
  const cv::Point moved(cvRound(box.x + box.width / 2 - box_.x - box_.width / 2),
                        cvRound(box.y + box.height / 2 - box_.y - box_.height / 2));
  const bool changed = comparable && !found_about(picture, {0, 0}) && !found_about(picture, moved);
  box_ = box;
  for (std::size_t i = 0; i < seen_.size(); ++i)
    seen_[i] = shade_at(picture, sample_place(i));
  return changed;
}

}  // namespace telehug
