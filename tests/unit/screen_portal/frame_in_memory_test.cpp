// SPDX-License-Identifier: Apache-2.0
#include "screen_portal/frame_in_memory.hpp"

#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <limits>
#include <numeric>
#include <vector>

namespace telehug {
namespace {

// Two rows of three pixels, with four bytes of padding behind the first, behind five bytes of something else.
class FrameInMemoryTest : public testing::Test {
 protected:
  FrameInMemoryTest() { std::iota(bytes.begin(), bytes.end(), std::uint8_t{0}); }

  std::array<std::uint8_t, 5 + 16 + 12> bytes{};
  FrameInMemory frame{.data = bytes.data(),
                      .bytes = bytes.size(),
                      .offset = 5,
                      .filled = 28,
                      .stride = 16,
                      .size = {.width_px = 3, .height_px = 2},
                      .order = PixelOrder::bgrx};
};

TEST_F(FrameInMemoryTest, FindsThePictureWhereItLies) {
  const auto found = find_frame(frame);
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_EQ(found->size(), cv::Size(3, 2));
  EXPECT_EQ(found->at<cv::Vec4b>(0, 0), cv::Vec4b(5, 6, 7, 8));
  EXPECT_EQ(found->at<cv::Vec4b>(1, 2), cv::Vec4b(29, 30, 31, 32));
}

TEST_F(FrameInMemoryTest, TakesRowsWithoutAStrideToLieSideBySide) {
  frame.stride = 0;
  frame.filled = 24;
  const auto found = find_frame(frame);
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_EQ(found->at<cv::Vec4b>(1, 0), cv::Vec4b(17, 18, 19, 20));
}

TEST_F(FrameInMemoryTest, RefusesWhatDoesNotFitOrMakesNoSense) {
  constexpr int most = std::numeric_limits<int>::max();
  constexpr std::size_t all = std::numeric_limits<std::size_t>::max();
  const std::vector<std::function<void(FrameInMemory&)>> lies{
      [](FrameInMemory& f) { f.data = nullptr; },
      [](FrameInMemory& f) {
        f.size = {0, 2};
      },
      [](FrameInMemory& f) {
        f.size = {3, 0};
      },
      [](FrameInMemory& f) {
        f.size = {-3, -2};
      },
      [](FrameInMemory& f) {
        f.size = {longest_screen_side_px + 1, 1};
      },
      [](FrameInMemory& f) {
        f.size = {most, most};
      },
      [](FrameInMemory& f) {
        f.size = {3, 3};
      },
      [](FrameInMemory& f) { f.stride = 11; },
      [](FrameInMemory& f) { f.stride = -16; },
      [](FrameInMemory& f) { f.stride = 17; },
      [](FrameInMemory& f) { f.stride = most; },
      [](FrameInMemory& f) { f.stride = std::numeric_limits<std::int64_t>::max(); },
      [](FrameInMemory& f) { f.stride = std::numeric_limits<std::int64_t>::min(); },
      [](FrameInMemory& f) { f.offset = 6; },
      [](FrameInMemory& f) { f.offset = 34; },
      [](FrameInMemory& f) { f.offset = all; },
      [](FrameInMemory& f) { f.filled = 27; },
      [](FrameInMemory& f) { f.filled = 29; },
      [](FrameInMemory& f) { f.filled = 0; },
      [](FrameInMemory& f) { f.filled = all; },
      [](FrameInMemory& f) { f.bytes = 32; },
      [](FrameInMemory& f) { f.bytes = 0; },
  };
  for (std::size_t i = 0; i < lies.size(); ++i) {
    FrameInMemory lie = frame;
    lies[i](lie);
    const auto found = find_frame(lie);
    EXPECT_FALSE(found) << "lie " << i;
    EXPECT_TRUE(found.ok() || !found.error().message.empty());
  }
}

TEST_F(FrameInMemoryTest, TurnsRedFirstIntoBlueFirst) {
  const auto found = find_frame(frame);
  ASSERT_TRUE(found);
  cv::Mat copy;
  copy_frame(*found, PixelOrder::rgbx, copy);
  EXPECT_EQ(copy.at<cv::Vec4b>(0, 1), cv::Vec4b(11, 10, 9, 12));
  const std::uint8_t* memory = copy.data;
  copy_frame(*found, PixelOrder::bgrx, copy);
  EXPECT_EQ(copy.at<cv::Vec4b>(0, 1), cv::Vec4b(9, 10, 11, 12));
  EXPECT_EQ(copy.data, memory) << "the memory is used again";
}

}  // namespace
}  // namespace telehug
