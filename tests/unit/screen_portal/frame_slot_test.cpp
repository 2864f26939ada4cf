// SPDX-License-Identifier: Apache-2.0
#include "screen_portal/frame_slot.hpp"

#include <gtest/gtest.h>

#include <array>

namespace telehug {
namespace {

using Taken = FrameSlot::Taken;

// Frames of one pixel whose blue tells them apart.
class FrameSlotTest : public testing::Test {
 protected:
  void put(std::uint8_t blue) {
    memory.at(blue)[0] = blue;
    slot.put({.data = memory.at(blue).data(), .bytes = 4, .filled = 4, .size = {.width_px = 1, .height_px = 1}},
             [this] { ++given_back; });
  }
  Taken take() {
    return slot.take(why, [this](const cv::Mat& found, PixelOrder) { blue_taken = found.at<cv::Vec4b>(0, 0)[0]; });
  }

  FrameSlot slot;
  std::array<std::array<std::uint8_t, 4>, 8> memory{};
  int given_back = 0;
  int blue_taken = -1;
  std::string why;
};

TEST_F(FrameSlotTest, HandsOverTheNewestFrameOnce) {
  EXPECT_EQ(take(), Taken::nothing);
  put(1);
  put(2);
  EXPECT_EQ(given_back, 1) << "a frame that nobody wants any more";
  EXPECT_EQ(take(), Taken::frame);
  EXPECT_EQ(blue_taken, 2);
  EXPECT_EQ(given_back, 2);
  EXPECT_EQ(take(), Taken::unchanged);
  put(3);
  EXPECT_EQ(take(), Taken::frame);
}

TEST_F(FrameSlotTest, KnowsOfNoFrameAfterItWasCleared) {
  put(1);
  ASSERT_EQ(take(), Taken::frame);
  put(2);
  slot.clear();
  EXPECT_EQ(take(), Taken::nothing);
  EXPECT_EQ(given_back, 1) << "the memory of the second has gone away already";
}

TEST_F(FrameSlotTest, ForgetsAFrameWhoseMemoryGoesAway) {
  put(1);
  ASSERT_EQ(take(), Taken::frame);
  put(2);
  slot.remove(memory[1].data());
  slot.remove(memory[2].data());
  EXPECT_EQ(take(), Taken::nothing) << "what was taken before is not the newest";
  EXPECT_EQ(given_back, 1);
}

TEST_F(FrameSlotTest, SaysWhatIsWrongUntilThereIsAFrame) {
  put(1);
  int odd_given_back = 0;
  slot.spoil("it is upside down", [&] { ++odd_given_back; });
  EXPECT_EQ(given_back + odd_given_back, 2);
  EXPECT_EQ(take(), Taken::spoiled);
  EXPECT_EQ(take(), Taken::spoiled);
  EXPECT_EQ(why, "it is upside down");
  slot.put({.data = nullptr, .size = {1, 1}}, [&] { ++odd_given_back; });
  EXPECT_EQ(odd_given_back, 2);
  EXPECT_EQ(take(), Taken::spoiled);
  EXPECT_NE(why, "it is upside down");
  put(2);
  EXPECT_EQ(take(), Taken::frame);
}

TEST_F(FrameSlotTest, KeepsTheFrameWhenWhatFollowsIsNothing) {
  put(1);
  bool back = false;
  slot.skip([&] { back = true; });
  EXPECT_TRUE(back);
  EXPECT_EQ(take(), Taken::frame);
  EXPECT_EQ(blue_taken, 1);
}

}  // namespace
}  // namespace telehug
