// SPDX-License-Identifier: Apache-2.0
#include "peer/heard_hugs.hpp"

#include <gtest/gtest.h>

#include "doubles/example_messages.hpp"
#include "doubles/fake_clock.hpp"

namespace telehug {
namespace {

class HugsThatAreHeard : public testing::Test {
 protected:
  static constexpr Duration clocks_differ = 5h;

  void hear_heartbeat(const SessionId& session = example_session) {
    Heartbeat heartbeat = example_heartbeat();
    heartbeat.session = session;
    heartbeat.sent_time_ns = sender_time();
    hugs.observe(heartbeat, clock.now());
  }
  [[nodiscard]] Hug hug(std::uint64_t sequence, const SessionId& session = example_session) const {
    return {.session = session, .sequence = sequence, .sent_time_ns = sender_time(), .strength = 1};
  }
  [[nodiscard]] std::int64_t sender_time() const { return to_ns(clock.now() + clocks_differ); }

  FakeClock clock;
  HeardHugs hugs;
};

TEST_F(HugsThatAreHeard, AreShownOnceEach) {
  hear_heartbeat();
  EXPECT_TRUE(hugs.shows(hug(1), clock.now()));
  EXPECT_FALSE(hugs.shows(hug(1), clock.now()));
  clock.advance(1s);
  EXPECT_TRUE(hugs.shows(hug(3), clock.now()));
  EXPECT_FALSE(hugs.shows(hug(2), clock.now())) << "it was overtaken";
}

TEST_F(HugsThatAreHeard, AreNotShownBeforeTheirSenderIsHeardOrOfAnotherOne) {
  EXPECT_FALSE(hugs.shows(hug(1), clock.now()));
  hear_heartbeat();
  EXPECT_FALSE(hugs.shows(hug(1, other_session), clock.now()));
  EXPECT_TRUE(hugs.shows(hug(1), clock.now()));
}

TEST_F(HugsThatAreHeard, CountAnewAfterARestartOfTheirSender) {
  hear_heartbeat();
  EXPECT_TRUE(hugs.shows(hug(9), clock.now()));
  hear_heartbeat(other_session);
  EXPECT_FALSE(hugs.shows(hug(10), clock.now())) << "of the session before";
  EXPECT_TRUE(hugs.shows(hug(1, other_session), clock.now()));
}

TEST_F(HugsThatAreHeard, AreNotShownWhenTheyAreLate) {
  hear_heartbeat();
  const Hug in_time = hug(1);
  const Hug late = hug(2);
  clock.advance(3s);
  EXPECT_TRUE(hugs.shows(in_time, clock.now()));
  clock.advance(1ns);
  EXPECT_FALSE(hugs.shows(late, clock.now()));
}

}  // namespace
}  // namespace telehug
