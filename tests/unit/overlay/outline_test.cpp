// SPDX-License-Identifier: Apache-2.0
#include "overlay/outline.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

namespace telehug {
namespace {

constexpr int side = 60;

// How often each px is covered.
cv::Mat1b paint(const std::vector<cv::Rect>& lines) {
  cv::Mat1b painted(side, side, std::uint8_t{0});
  for (const cv::Rect& line : lines)
    painted(line) += 1;
  return painted;
}

// What lies in the box, in the bounds, and less than `width` from one of the box's edges.
cv::Mat1b expected(const cv::Rect& box, int width, const cv::Rect& bounds) {
  cv::Mat1b painted(side, side, std::uint8_t{0});
  const cv::Rect inner(box.x + width, box.y + width, box.width - 2 * width, box.height - 2 * width);
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const cv::Point place(x, y);
      const bool inside = inner.width > 0 && inner.height > 0 && inner.contains(place);
      painted(y, x) = box.contains(place) && bounds.contains(place) && !inside ? 1 : 0;
    }
  }
  return painted;
}

TEST(AnOutline, LiesWithinTheBoxAndCoversNothingTwice) {
  const cv::Rect bounds(0, 0, 50, 40);
  for (const cv::Rect& box : {cv::Rect(5, 6, 30, 20), cv::Rect(0, 0, 50, 40), cv::Rect(-10, -10, 30, 30),
                              cv::Rect(30, 20, 100, 100), cv::Rect(-5, 10, 80, 10), cv::Rect(7, 7, 5, 20),
                              cv::Rect(7, 7, 20, 5), cv::Rect(7, 7, 1, 1), cv::Rect(7, 7, 6, 6)}) {
    for (const int width : {1, 3}) {
      const cv::Mat difference = paint(make_outline(box, width, bounds)) != expected(box, width, bounds);
      EXPECT_EQ(cv::countNonZero(difference), 0) << box << " " << width;
    }
  }
}

TEST(AnOutline, IsEmptyIfThereIsNothingToSee) {
  const cv::Rect bounds(0, 0, 50, 40);
  EXPECT_TRUE(make_outline({60, 0, 10, 10}, 3, bounds).empty());
  EXPECT_TRUE(make_outline({-10, -10, 100, 100}, 3, bounds).empty()) << "all its lines lie outside";
  EXPECT_TRUE(make_outline({5, 5, 0, 10}, 3, bounds).empty());
  EXPECT_TRUE(make_outline({5, 5, 10, 10}, 0, bounds).empty());
  EXPECT_TRUE(make_outline({5, 5, 10, 10}, 3, {}).empty());
}

}  // namespace
}  // namespace telehug
