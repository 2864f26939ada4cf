// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <limits>
#include <queue>
#include <random>

#include "doubles/example_messages.hpp"
#include "doubles/fake_clock.hpp"
#include "peer/heartbeat_exchange.hpp"
#include "peer/peer_monitor.hpp"

namespace telehug {
namespace {

Heartbeat beat_of(const SessionId& session, std::uint64_t sequence) {
  Heartbeat heartbeat;
  heartbeat.session = session;
  heartbeat.sequence = sequence;
  return heartbeat;
}

TEST(HeartbeatExchange, BeatsTenTimesASecondAndNumbersTheBeats) {
  FakeClock clock;
  HeartbeatExchange exchange(example_session, Side::passive);
  std::uint64_t beats = 0;
  for (int ms = 0; ms < 1000; ++ms, clock.advance(1ms)) {
    if (clock.now() < exchange.next_due()) continue;
    const Heartbeat& beat = exchange.beat(clock.now());
    EXPECT_EQ(beat.sequence, ++beats);
    EXPECT_EQ(beat.session, example_session);
    EXPECT_EQ(beat.side, Side::passive);
    EXPECT_EQ(beat.sent_time_ns, to_ns(clock.now()));
  }
  EXPECT_EQ(beats, 10U);
}

// A negative time would be refused by the wire: a beat less.
TEST(HeartbeatExchange, HasHeldABeatForNoTimeThatCameInAfterTheClockWasLookedAt) {
  HeartbeatExchange exchange(example_session, Side::active);
  exchange.heard(beat_of(other_session, 1), from_ns(1'000'000'010));
  EXPECT_EQ(exchange.beat(from_ns(1'000'000'000)).echo_held_ns, 0);
}

TEST(HeartbeatExchange, KeepsItsRhythmWhenABeatIsLateAndDoesNotCatchUpAfterAStall) {
  FakeClock clock;
  HeartbeatExchange exchange(example_session, Side::active);
  exchange.beat(clock.now());
  const Timestamp second = exchange.next_due();
  exchange.beat(second + 30ms);
  EXPECT_EQ(exchange.next_due(), second + 100ms);
  exchange.beat(second + 5s);
  EXPECT_EQ(exchange.next_due(), second + 5100ms);
}

TEST(HeartbeatExchange, HasNoRoundTripBeforeAnAnswer) {
  HeartbeatExchange exchange(example_session, Side::active);
  EXPECT_TRUE(exchange.beat(from_ns(1000)).echo_session.empty());
  exchange.heard(beat_of(other_session, 1), from_ns(2000));
  EXPECT_FALSE(exchange.round_trip().has_value());
}

TEST(HeartbeatExchange, MeasuresTheWayWithoutTheTimeThatThePeerHeldTheStamp) {
  // The peer's clock is an hour ahead; 3 ms there, 4 ms back, held for 60 ms.
  HeartbeatExchange here(example_session, Side::active);
  HeartbeatExchange there(other_session, Side::passive);
  const Timestamp start = from_ns(5'000'000'000);
  there.heard(here.beat(start), start + 3ms + 1h);
  here.heard(there.beat(start + 63ms + 1h), start + 67ms);
  ASSERT_TRUE(here.round_trip().has_value());
  EXPECT_EQ(*here.round_trip(), 7ms);
  EXPECT_EQ(*here.smoothed_round_trip(), 7ms);
}

// Answers of a peer whose clock is an hour ahead and that is 3 ms away: what comes late, comes late on the way to here.
TEST(HeartbeatExchange, TellsHowLongABeatWasOnItsWayAlthoughTheClocksDiffer) {
  HeartbeatExchange here(example_session, Side::active);
  HeartbeatExchange there(other_session, Side::passive);
  Timestamp now = from_ns(5'000'000'000);
  EXPECT_FALSE(here.one_way().has_value());
  for (const Duration extra : {0ms, 40ms, 7ms}) {
    there.heard(here.beat(now), now + 3ms + 1h);
    here.heard(there.beat(now + 3ms + 1h), now + 6ms + extra);
    EXPECT_EQ(here.one_way(), 3ms + extra);
    now += 100ms;
  }
}

TEST(HeartbeatExchange, SmoothsTheRoundTripAndForgetsItWithThePeersSession) {
  HeartbeatExchange here(example_session, Side::active);
  const Timestamp start = from_ns(1'000'000'000);
  Heartbeat answer = beat_of(other_session, 1);
  answer.echo_session = example_session;
  answer.echo_sent_time_ns = to_ns(start);
  here.heard(answer, start + 8ms);
  here.heard(answer, start + 16ms);
  EXPECT_EQ(*here.round_trip(), 16ms);
  EXPECT_EQ(*here.smoothed_round_trip(), 9ms);
  here.heard(beat_of(SessionId(32, 'a'), 1), start + 20ms);
  EXPECT_FALSE(here.round_trip().has_value());
}

TEST(HeartbeatExchange, IgnoresImpossibleEchoes) {
  HeartbeatExchange here(example_session, Side::active);
  const Timestamp now = from_ns(1'000'000'000);
  Heartbeat answer = beat_of(other_session, 1);
  answer.echo_session = example_session;
  for (const auto& [stamp, held] : std::vector<std::pair<std::int64_t, std::int64_t>>{
           {to_ns(now) + 1, 0},
           {std::numeric_limits<std::int64_t>::max(), 0},
           {std::numeric_limits<std::int64_t>::min(), 0},
           {to_ns(now) - 10, 11},
           {to_ns(now) - 10, std::numeric_limits<std::int64_t>::max()},
           {to_ns(now) - 10, std::numeric_limits<std::int64_t>::min()}}) {
    answer.echo_sent_time_ns = stamp;
    answer.echo_held_ns = held;
    here.heard(answer, now);
    EXPECT_FALSE(here.round_trip().has_value()) << stamp << " held " << held;
  }
  answer.echo_session = SessionId(32, 'a');  // an answer to somebody else
  answer.echo_sent_time_ns = to_ns(now) - 10;
  answer.echo_held_ns = 1;
  here.heard(answer, now);
  EXPECT_FALSE(here.round_trip().has_value());
}

TEST(PeerMonitor, SaysThatNobodyLivesBeforeTheFirstHeartbeat) {
  PeerMonitor monitor;
  EXPECT_FALSE(monitor.alive(from_ns(0)));
  EXPECT_TRUE(monitor.session().empty());
  EXPECT_EQ(monitor.losses(), 0U);
}

TEST(PeerMonitor, NoticesAPeerThatFallsSilentAndOneThatReturns) {
  FakeClock clock;
  PeerMonitor monitor(250ms);
  EXPECT_TRUE(monitor.heard(beat_of(example_session, 1), clock.now()));
  clock.advance(250ms);
  EXPECT_TRUE(monitor.alive(clock.now()));
  clock.advance(1ms);
  EXPECT_FALSE(monitor.alive(clock.now()));
  EXPECT_FALSE(monitor.alive(clock.now()));
  EXPECT_EQ(monitor.losses(), 1U);
  EXPECT_TRUE(monitor.heard(beat_of(example_session, 2), clock.now()));
  EXPECT_TRUE(monitor.alive(clock.now()));
  EXPECT_EQ(monitor.losses(), 1U);
}

TEST(PeerMonitor, CountsALossThatNobodyAskedAbout) {
  FakeClock clock;
  PeerMonitor monitor;
  monitor.heard(beat_of(example_session, 1), clock.now());
  clock.advance(1s);
  monitor.heard(beat_of(example_session, 2), clock.now());
  EXPECT_EQ(monitor.losses(), 1U);
}

TEST(PeerMonitor, IsNotKeptAliveByDuplicatesOrOldPackets) {
  FakeClock clock;
  PeerMonitor monitor;
  monitor.heard(beat_of(example_session, 5), clock.now());
  for (int i = 0; i < 6; ++i) {
    clock.advance(50ms);
    EXPECT_FALSE(monitor.heard(beat_of(example_session, 5), clock.now()));
    EXPECT_FALSE(monitor.heard(beat_of(example_session, 4), clock.now()));
  }
  EXPECT_FALSE(monitor.alive(clock.now()));
  EXPECT_EQ(monitor.ignored(), 12U);
}

TEST(PeerMonitor, IgnoresAnOldSessionOnceANewOneHasStarted) {
  FakeClock clock;
  PeerMonitor monitor;
  monitor.heard(beat_of(example_session, 900), clock.now());
  EXPECT_TRUE(monitor.heard(beat_of(other_session, 1), clock.now()));
  EXPECT_EQ(monitor.session(), other_session);
  for (std::uint64_t i = 0; i < 6; ++i) {
    clock.advance(50ms);
    EXPECT_FALSE(monitor.heard(beat_of(example_session, 901 + i), clock.now()));
  }
  EXPECT_FALSE(monitor.alive(clock.now()));
  EXPECT_EQ(monitor.session(), other_session);
}

// Any heartbeat may be lost as long as no three in a row are; delays vary by up to 40 ms, so packets overtake each
// other.
TEST(PeerMonitor, KeepsAPeerAliveThroughLossDuplicationAndReordering) {
  std::mt19937 random(7);
  std::uniform_int_distribution<int> chance(0, 99);
  std::uniform_int_distribution<int> delay_ms(0, 40);
  using Arrival = std::pair<std::int64_t, std::uint64_t>;
  std::priority_queue<Arrival, std::vector<Arrival>, std::greater<>> way;
  PeerMonitor monitor(350ms);
  std::uint64_t sequence = 0;
  int lost_in_a_row = 0;
  for (std::int64_t ms = 0; ms < 100'000; ++ms) {
    if (ms % 100 == 0) {
      ++sequence;
      const bool lost = lost_in_a_row < 2 && chance(random) < 30 && sequence > 1;
      lost_in_a_row = lost ? lost_in_a_row + 1 : 0;
      for (int copies = lost ? 0 : 1 + (chance(random) < 10 ? 1 : 0); copies > 0; --copies) {
        way.emplace(ms + delay_ms(random), sequence);
      }
    }
    const Timestamp now = from_ns(ms * 1'000'000);
    for (; !way.empty() && way.top().first == ms; way.pop())
      monitor.heard(beat_of(example_session, way.top().second), now);
    if (ms > 40) {
      ASSERT_TRUE(monitor.alive(now)) << "at " << ms << " ms";
    }
  }
  EXPECT_GT(monitor.ignored(), 0U);
  EXPECT_EQ(monitor.losses(), 0U);
}

}  // namespace
}  // namespace telehug
