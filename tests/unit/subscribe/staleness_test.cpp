// SPDX-License-Identifier: Apache-2.0
#include "subscribe/staleness.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "doubles/example_messages.hpp"

namespace telehug {
namespace {

// A sender whose clock shows something else, and a way of some length between it and the receiver.
class MessagesWithStamps : public testing::Test {
 protected:
  // Sends at the receiver's time `at` (since the test's start) and lets it arrive after `way`.
  Duration arrive(Duration at, Duration way) {
    return staleness.observe(session, to_ns(start + at + sender_ahead), start + at + way);
  }

  Timestamp start = from_ns(50'000'000'000'000);
  Duration sender_ahead = 7h;
  SessionId session = example_session;
  Staleness staleness;
};

TEST_F(MessagesWithStamps, AreAsOldAsTheyWereSlowerThanTheFastest) {
  EXPECT_EQ(arrive(0ms, 20ms), 0ms);
  EXPECT_EQ(arrive(100ms, 35ms), 15ms);
  EXPECT_EQ(arrive(200ms, 12ms), 0ms);
  EXPECT_EQ(arrive(300ms, 20ms), 8ms);
}

TEST_F(MessagesWithStamps, AreJudgedTheSameWhicheverClockIsAhead) {
  sender_ahead = -7h;
  arrive(0ms, 20ms);
  EXPECT_EQ(arrive(100ms, 220ms), 200ms);
}

TEST_F(MessagesWithStamps, AreTooOldToBeFeltAfter150Milliseconds) {
  TouchEvent event = example_touch();
  const Timestamp now = start;
  event.sent_time_ns = to_ns(now) - 1'000'000;
  EXPECT_FALSE(staleness.is_stale(event, now));
  EXPECT_FALSE(staleness.is_stale(event, now + 150ms));
  EXPECT_EQ(staleness.touch_age(), 150ms);
  EXPECT_TRUE(staleness.is_stale(event, now + 151ms));
  EXPECT_EQ(staleness.stale_count(), 1U);
}

TEST_F(MessagesWithStamps, AreJudgedByTheLastTenSecondsOnly) {
  arrive(0s, 10ms);
  for (Duration at = 0s; at < 9s; at += 100ms)
    EXPECT_EQ(arrive(at, 210ms), 200ms);
  for (Duration at = 9s; at < 12s; at += 100ms)
    arrive(at, 210ms);
  EXPECT_EQ(arrive(12s, 210ms), 0ms) << "the longer way is believed by now";
}

TEST_F(MessagesWithStamps, ThatWereStuckInALongStallAreStillOld) {
  arrive(0s, 10ms);
  const Duration released = 40s;
  for (Duration sent = 1s; sent < 35s; sent += 1s)
    EXPECT_GT(arrive(sent, released - sent), 4900ms);
  const Duration live = arrive(released, 10ms);
  EXPECT_GE(live, 0ms);
  EXPECT_LT(live, 10ms);
}

TEST_F(MessagesWithStamps, OfAClockThatDriftsDoNotBecomeStaleOverHours) {
  // 100 parts per million slow sender: its stamps fall behind by 0.36 s an hour. Silence of an hour in between.
  const auto drifted = [](Duration at) { return at + at / 10'000; };
  for (const Duration begin : {Duration(0h), Duration(1h), Duration(2h)}) {
    for (Duration at = begin; at < begin + 60s; at += 100ms) {
      const Duration age = staleness.observe(session, to_ns(start + at), start + drifted(at) + 10ms);
      ASSERT_LT(age, 5ms) << to_ms(at);
    }
  }
}

TEST_F(MessagesWithStamps, OfANewSessionBeginAnew) {
  arrive(0s, 10ms);
  session = other_session;
  sender_ahead = -1h;
  EXPECT_EQ(arrive(1s, 30ms), 0ms);
}

TEST_F(MessagesWithStamps, WithExtremeTimesDoNotOverflow) {
  EXPECT_EQ(staleness.observe(session, std::numeric_limits<std::int64_t>::max(), from_ns(0)), 0ms);
  EXPECT_GT(staleness.observe(session, 0, from_ns(1)), 0ms);
  staleness.observe(other_session, 0, start);
  EXPECT_EQ(staleness.observe(other_session, std::numeric_limits<std::int64_t>::max(), start + 1h), 0ms);
  EXPECT_GT(staleness.observe(other_session, 0, start + 3h), 0ms);
}

TEST_F(MessagesWithStamps, AreNeverOfNegativeAge) {
  std::mt19937 random(3);
  Duration at = 0s;
  for (int i = 0; i < 100'000; ++i) {
    at += std::chrono::milliseconds(random() % 300);
    ASSERT_GE(arrive(at, std::chrono::milliseconds(random() % 250)), 0ms);
  }
}

}  // namespace
}  // namespace telehug
