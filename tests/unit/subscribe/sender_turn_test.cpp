// SPDX-License-Identifier: Apache-2.0
#include "subscribe/sender_turn.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace telehug {
namespace {

const Timestamp start = from_ns(1'000'000'000);

TEST(SenderNumbers, AreFreeAgainWhenTheirSenderIsGoneAndNeverBeyondTheLast) {
  std::vector<SenderNumber> taken;
  for (std::size_t i = 0; i < wearers_number; ++i)
    taken.push_back(free_sender_number(taken).value());
  EXPECT_FALSE(free_sender_number(taken));
  taken.erase(taken.begin() + 3);
  EXPECT_EQ(free_sender_number(taken), 3);
}

TEST(MergedSenders, MayAllTouchAtOnce) {
  SenderTurn turn(false);
  EXPECT_TRUE(turn.take(0, true, start));
  EXPECT_TRUE(turn.take(1, true, start));
}

TEST(ExclusiveSenders, WaitUntilTheOneWhoBeganHasNotTouchedForAWhile) {
  SenderTurn turn(true);
  EXPECT_TRUE(turn.take(0, true, start));
  EXPECT_FALSE(turn.take(1, true, start + 1s));
  EXPECT_TRUE(turn.take(0, true, start + 1s));
  EXPECT_FALSE(turn.take(1, true, start + 1s + SenderTurn::pause - 1ms));
  EXPECT_TRUE(turn.take(1, true, start + 1s + SenderTurn::pause));
  EXPECT_FALSE(turn.take(0, true, start + 1s + SenderTurn::pause));
}

TEST(ExclusiveSenders, DoNotTakeTheTurnWithoutATouch) {
  SenderTurn turn(true);
  EXPECT_TRUE(turn.take(0, false, start));
  EXPECT_TRUE(turn.take(1, true, start));
}

TEST(ExclusiveSenders, LoseTheTurnWhileTheyOnlySayThatNothingTouches) {
  SenderTurn turn(true);
  ASSERT_TRUE(turn.take(0, true, start));
  for (Duration passed{}; passed < SenderTurn::pause; passed += 100ms)
    ASSERT_TRUE(turn.take(0, false, start + passed));
  EXPECT_TRUE(turn.take(1, true, start + SenderTurn::pause));
}

}  // namespace
}  // namespace telehug
