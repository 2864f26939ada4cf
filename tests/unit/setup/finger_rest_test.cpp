// SPDX-License-Identifier: Apache-2.0
#include "setup/finger_rest.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "doubles/fake_clock.hpp"

namespace telehug {
namespace {

class Resting : public testing::Test {
 protected:
  // Frames at 30 Hz of a finger whose place follows from the frame.
  template <typename Place>
  void frames(int count, Place place) {
    for (int i = 0; i < count; ++i) {
      clock.advance(33'333us);
      rest.look(place(i), clock.now());
    }
  }
  static std::optional<ScreenPoint> still(int /*frame*/) { return ScreenPoint{100, 200}; }

  FakeClock clock;
  FingerRest rest;
};

TEST_F(Resting, IsAFingerThatIsStillForSixTenthsOfASecond) {
  frames(18, still);
  EXPECT_FALSE(rest.rests());
  EXPECT_GT(rest.progress(), 0.9);
  frames(2, still);
  EXPECT_TRUE(rest.rests());
  EXPECT_EQ(*rest.place(), (ScreenPoint{100, 200}));
}

TEST_F(Resting, IsAFingerThatTremblesByAMillimetre) {
  frames(20, [](int i) { return std::optional(ScreenPoint{100 + std::sin(1.7 * i), 200 + std::cos(2.3 * i)}); });
  EXPECT_TRUE(rest.rests());
  EXPECT_NEAR(rest.place()->x_mm, 100, 1);
}

TEST_F(Resting, IsNotAFingerThatPassesAtTwentyMillimetresASecond) {
  double largest = 0;
  frames(90, [&](int i) {
    largest = std::max(largest, rest.progress());
    return std::optional(ScreenPoint{100 + 20.0 * i / 30, 200});
  });
  EXPECT_LT(largest, 0.9);
}

TEST_F(Resting, IsNotAHandThatShakesByFiveMillimetres) {
  double largest = 0;
  frames(90, [&](int i) {
    largest = std::max(largest, rest.progress());
    return std::optional(ScreenPoint{100 + 5 * std::sin(2 * i), 200});
  });
  EXPECT_LT(largest, 0.9);
}

TEST_F(Resting, ForgivesAFingerThatIsMissedOrMisplacedNowAndThen) {
  frames(20, [](int i) -> std::optional<ScreenPoint> {
    if (i % 8 == 3) return std::nullopt;
    return ScreenPoint{i % 8 == 5 ? 140.0 : 100.0, 200};
  });
  EXPECT_FALSE(rest.rests()) << "a quarter of the frames is too much";
  rest.forget();
  frames(20, [](int i) -> std::optional<ScreenPoint> {
    if (i % 6 == 4) return std::nullopt;
    return ScreenPoint{100, 200};
  });
  EXPECT_TRUE(rest.rests());
}

TEST_F(Resting, BeginsAnewWhereTheFingerStopsNext) {
  frames(30, still);
  frames(30, [](int) { return std::optional(ScreenPoint{150, 220}); });
  EXPECT_TRUE(rest.rests());
  EXPECT_EQ(*rest.place(), (ScreenPoint{150, 220}));
  EXPECT_LT(rest.still_for(), 900ms);
}

TEST_F(Resting, IsOverWhenTheFingerIsGone) {
  frames(30, still);
  frames(10, [](int) { return std::optional<ScreenPoint>(); });
  EXPECT_FALSE(rest.rests());
  EXPECT_FALSE(rest.place().has_value());
}

TEST_F(Resting, NeedsEnoughFramesOfASlowCamera) {
  for (int i = 0; i < 6; ++i) {
    clock.advance(200ms);
    rest.look(still(i), clock.now());
  }
  EXPECT_FALSE(rest.rests()) << "six frames in a second";
}

}  // namespace
}  // namespace telehug
