// SPDX-License-Identifier: Apache-2.0
#include "screen_x11/left_out_areas.hpp"

#include <algorithm>
#include <array>

namespace telehug {

bool is_covered(const cv::Rect& rect, std::span<const cv::Rect> areas) {
  if (rect.empty()) {
    return true;
  }
  while (!areas.empty() && (rect & areas.front()).empty()) {
    areas = areas.subspan(1);
  }
  if (areas.empty()) {
    return false;
  }
  // What is left of `rect` above, below, left and right of the first area must lie in the others.
  const cv::Rect taken = rect & areas.front();
  const std::array<cv::Rect, 4> rest{
      cv::Rect(rect.x, rect.y, rect.width, taken.y - rect.y),
      cv::Rect(rect.x, taken.br().y, rect.width, rect.br().y - taken.br().y),
      cv::Rect(rect.x, taken.y, taken.x - rect.x, taken.height),
      cv::Rect(taken.br().x, taken.y, rect.br().x - taken.br().x, taken.height),
  };
  return std::all_of(rest.begin(), rest.end(),
                     [others = areas.subspan(1)](const cv::Rect& part) { return is_covered(part, others); });
}

void KeptAreas::keep(const cv::Mat& picture, std::span<const cv::Rect> areas_px) {
  kept_.clear();
  const cv::Rect whole(0, 0, picture.cols, picture.rows);
  for (const cv::Rect& area : areas_px) {
    if (const cv::Rect inside = area & whole; !inside.empty()) {
      kept_.push_back({inside, picture(inside).clone()});
    }
  }
}

void KeptAreas::put_back(cv::Mat& picture) const {
  for (const Kept& kept : kept_) {
    kept.pixels.copyTo(picture(kept.area_px));
  }
}

}  // namespace telehug
