// SPDX-License-Identifier: Apache-2.0
#include "screen_x11/x11_monitors.hpp"

#include <gmock/gmock.h>

namespace telehug {
namespace {

using testing::HasSubstr;

const std::vector<X11Monitor> two{{.name = "DP-1", .place_px = {0, 0, 800, 600}},
                                  {.name = "HDMI-1", .primary = true, .place_px = {800, 0, 640, 480}}};

TEST(X11Monitors, AreChosenByName) {
  EXPECT_EQ(choose_x11_monitor(two, "DP-1")->name, "DP-1");
  EXPECT_EQ(choose_x11_monitor(two, "HDMI-1")->place_px, cv::Rect(800, 0, 640, 480));
}

TEST(X11Monitors, AreThePrimaryOneElseTheFirstIfNoneIsNamed) {
  EXPECT_EQ(choose_x11_monitor(two, "")->name, "HDMI-1");
  EXPECT_EQ(choose_x11_monitor({two[0]}, "")->name, "DP-1");
}

TEST(X11Monitors, AreListedIfTheOneOfTheNameIsMissing) {
  const auto missing = choose_x11_monitor(two, "HDMI");
  ASSERT_FALSE(missing);
  EXPECT_THAT(missing.error().message, HasSubstr("no monitor HDMI; plug it in or choose one of these: DP-1, HDMI-1."));
  const auto none = choose_x11_monitor({}, "");
  ASSERT_FALSE(none);
  EXPECT_THAT(none.error().message, HasSubstr("shows no monitor"));
}

}  // namespace
}  // namespace telehug
