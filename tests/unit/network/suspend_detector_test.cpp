// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "doubles/fake_clock.hpp"
#include "network/suspend_detector.hpp"

namespace telehug {
namespace {

TEST(SuspendDetector, SaysOnceThatThePcSlept) {
  FakeClock clock;
  SuspendDetector detector;
  Duration asleep = 3h;  // before the daemon started
  const auto resumed = [&] { return detector.resumed(clock.now(), clock.now().time_since_epoch() + asleep); };
  EXPECT_FALSE(resumed());
  clock.advance(10min);
  EXPECT_FALSE(resumed());
  asleep += 2s;
  EXPECT_TRUE(resumed());
  clock.advance(1s);
  EXPECT_FALSE(resumed());
  asleep += 8h;
  EXPECT_TRUE(resumed());
}

TEST(SuspendDetector, IsNotMisledByTheMomentBetweenReadingTheClocks) {
  FakeClock clock;
  SuspendDetector detector;
  for (int i = 0; i < 1000; ++i, clock.advance(10ms)) {
    EXPECT_FALSE(detector.resumed(clock.now(), clock.now().time_since_epoch() + (i % 2) * 400ms));
  }
}

TEST(SuspendDetector, ReadsClocksThatAgreeWhileThePcIsAwake) {
  SuspendDetector detector;
  for (int i = 0; i < 100; ++i)
    EXPECT_FALSE(detector.resumed(SteadyClock().now(), time_since_boot()));
}

}  // namespace
}  // namespace telehug
