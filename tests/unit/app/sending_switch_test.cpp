// SPDX-License-Identifier: Apache-2.0
#include "sending_switch.hpp"

#include <gtest/gtest.h>

namespace telehug {
namespace {

using enum SendingMode;
using enum SendingVerdict;

const ScreenView file{.live = false, .pins_window = false, .in_front = {}};
const ScreenView whole_screen{.live = true, .pins_window = false, .in_front = {}};
const ScreenView in_front{.live = true, .pins_window = true, .in_front = true};
const ScreenView behind{.live = true, .pins_window = true, .in_front = false};
const ScreenView window_gone{.live = true, .pins_window = true, .in_front = {}};

TEST(SendingSwitch, SendsNothingWhenItIsOff) {
  for (const ScreenView& screen : {file, whole_screen, in_front, behind, window_gone})
    EXPECT_EQ(judge_sending(off, true, false, screen), switched_off);
}

TEST(SendingSwitch, SendsByItselfOnlyWhileThePinnedWindowIsInFront) {
  EXPECT_EQ(judge_sending(automatic, true, false, in_front), sends);
  EXPECT_EQ(judge_sending(automatic, true, false, behind), covered);
  EXPECT_EQ(judge_sending(automatic, true, false, whole_screen), never_pinned);
}

TEST(SendingSwitch, SendsFromAFileByItself) {
  EXPECT_EQ(judge_sending(automatic, true, false, file), sends);
}

TEST(SendingSwitch, SendsFromAWholeScreenWhenItIsOn) {
  EXPECT_EQ(judge_sending(on, true, false, whole_screen), sends);
}

TEST(SendingSwitch, SendsNothingFromBehindAnotherWindowUnlessThatIsAllowed) {
  EXPECT_EQ(judge_sending(on, true, false, behind), covered);
  EXPECT_EQ(judge_sending(on, false, false, behind), sends);
  EXPECT_EQ(judge_sending(automatic, false, false, behind), sends);
}

TEST(SendingSwitch, SendsNothingWhileThePinnedWindowIsNotSeen) {
  for (const SendingMode mode : {automatic, on}) {
    EXPECT_EQ(judge_sending(mode, true, false, window_gone), not_seen);
    EXPECT_EQ(judge_sending(mode, false, false, window_gone), not_seen);
  }
}

TEST(SendingSwitch, SendsNothingWhileAPageUsesTheFingers) {
  for (const SendingMode mode : {automatic, on})
    for (const ScreenView& screen : {file, whole_screen, in_front, behind, window_gone})
      EXPECT_EQ(judge_sending(mode, false, true, screen), used_here);
}

TEST(SendingSwitch, BeginsAsConfiguredAndOffWhenThatMeansNothing) {
  EXPECT_EQ(SendingSwitch("auto", true).mode(), automatic);
  EXPECT_EQ(SendingSwitch("on", true).mode(), on);
  EXPECT_EQ(SendingSwitch("off", true).mode(), off);
  EXPECT_EQ(SendingSwitch("nonsense", true).mode(), off);
}

TEST(SendingSwitch, TogglesBetweenOffAndWhatItWas) {
  for (const char* start : {"on", "auto"}) {
    SendingSwitch sending(start, true);
    sending.toggle();
    EXPECT_EQ(sending.mode(), off);
    sending.toggle();
    EXPECT_STREQ(name_of(sending.mode()), start);
  }
  SendingSwitch sending("off", true);
  sending.toggle();
  EXPECT_EQ(sending.mode(), automatic);
}

}  // namespace
}  // namespace telehug
