// SPDX-License-Identifier: Apache-2.0
#include "capture/virtual_rig/touch_script.hpp"

#include <gtest/gtest.h>

namespace telehug {
namespace {

constexpr ScreenSize screen{380, 300, 1280, 1024};
const TouchScript one_stroke{{{1.0, 2.0, {100, 200}, {200, 240}}}, 3.0};

TEST(TouchScript, LetsTheFingerComeTouchAndGo) {
  EXPECT_FALSE(finger_at(one_stroke, 0.6).has_value());
  const auto coming = finger_at(one_stroke, 0.85);
  ASSERT_TRUE(coming.has_value());
  EXPECT_NEAR(coming->hover_mm, approach_from_mm / 2, 1e-9);
  EXPECT_EQ(coming->foot.x_mm, 100);
  for (const double time_s : {1.0, 1.5, 2.0})
    EXPECT_EQ(finger_at(one_stroke, time_s)->hover_mm, 0);
  EXPECT_GT(finger_at(one_stroke, 2.01)->hover_mm, 0);
  EXPECT_FALSE(finger_at(one_stroke, 2.4).has_value());
}

TEST(TouchScript, MovesFromTheFirstPointToTheSecond) {
  EXPECT_EQ(finger_at(one_stroke, 1.0)->foot.x_mm, 100);
  EXPECT_NEAR(finger_at(one_stroke, 1.5)->foot.x_mm, 150, 1e-9);
  EXPECT_NEAR(finger_at(one_stroke, 1.5)->foot.y_mm, 220, 1e-9);
  EXPECT_EQ(finger_at(one_stroke, 2.0)->foot.y_mm, 240);
}

TEST(TouchScript, IsTheSameForTheSameSeedOnly) {
  const TouchScript a = random_script(screen, 10, 7);
  const TouchScript b = random_script(screen, 10, 7);
  const TouchScript c = random_script(screen, 10, 8);
  ASSERT_EQ(a.touches.size(), 10u);
  for (std::size_t i = 0; i < 10; ++i) {
    EXPECT_EQ(a.touches[i].from.x_mm, b.touches[i].from.x_mm);
    EXPECT_EQ(a.touches[i].begin_s, b.touches[i].begin_s);
    EXPECT_NE(a.touches[i].from.x_mm, c.touches[i].from.x_mm);
  }
}

}  // namespace
}  // namespace telehug
