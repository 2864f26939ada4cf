// SPDX-License-Identifier: Apache-2.0
#include "overlay/outline.hpp"

#include <algorithm>
#include <array>

namespace telehug {

std::vector<cv::Rect> make_outline(const cv::Rect& box, int width, const cv::Rect& bounds) {
  std::vector<cv::Rect> lines;
  if (box.empty() || width <= 0) {
    return lines;
  }
  // A box that is smaller than its lines is filled.
  const int top = std::min(width, box.height);
  const int bottom = std::min(width, box.height - top);
  const int between = box.height - top - bottom;
  const int left = std::min(width, box.width);
  const int right = std::min(width, box.width - left);
  const std::array sides{
      cv::Rect(box.x, box.y, box.width, top), cv::Rect(box.x, box.br().y - bottom, box.width, bottom),
      cv::Rect(box.x, box.y + top, left, between), cv::Rect(box.br().x - right, box.y + top, right, between)};
  for (const cv::Rect& side : sides) {
    if (const cv::Rect seen = side & bounds; !seen.empty()) {
      lines.push_back(seen);
    }
  }
  return lines;
}

}  // namespace telehug
