// SPDX-License-Identifier: Apache-2.0
#include "screen/watched_part.hpp"

#include <fmt/format.h>

#include <cstdint>

namespace telehug {

Result<cv::Rect> watched_part(const std::optional<cv::Rect>& wanted, cv::Size size, std::string_view picture) {
  const cv::Rect whole({0, 0}, size);
  // In 64 bits: the corner of a part from a config file may lie beyond what an int holds.
  const cv::Rect_<std::int64_t> part = wanted.value_or(whole);
  const cv::Rect_<std::int64_t> seen = part & cv::Rect_<std::int64_t>(whole);
  if (seen.empty()) {
    return Error{fmt::format("The part to look at, {}x{} px at {},{}, lies outside of {} ({}x{} px); correct it.",
                             part.width, part.height, part.x, part.y, picture, size.width, size.height)};
  }
  return cv::Rect(seen);
}

}  // namespace telehug
