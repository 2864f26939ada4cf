// SPDX-License-Identifier: Apache-2.0
#include "link/legacy_session.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "doubles/fake_clock.hpp"

namespace telehug {
namespace {

using ::testing::ElementsAre;
using ::testing::Ge;
using ::testing::IsEmpty;

class LegacySessionTest : public ::testing::Test {
 protected:
  std::vector<std::uint8_t> said(bool has_backlog = false) {
    const EncodedFrame bytes = session.next_frame(clock.now(), has_backlog);
    return {bytes.begin(), bytes.end()};
  }
  bool send(const MotorCommands& commands) { return session.send(commands, clock.now()); }

  void start() {
    session.connected(clock.now());
    clock.advance(2s);
    ASSERT_THAT(said(), IsEmpty());
    ASSERT_EQ(session.status().state, LinkState::armed);
  }

  FakeClock clock;
  LegacySession session;
};

TEST_F(LegacySessionTest, SaysNothingUntilTheBootloaderIsThrough) {
  EXPECT_EQ(session.status().state, LinkState::absent);
  session.connected(clock.now());
  EXPECT_EQ(session.status().state, LinkState::connecting);
  EXPECT_FALSE(send({{3, 255, 200ms}}));
  clock.advance(1999ms);
  EXPECT_THAT(said(), IsEmpty());
  EXPECT_EQ(session.status().state, LinkState::connecting);
  clock.advance(1ms);
  EXPECT_THAT(said(), IsEmpty()) << "what was asked for before is forgotten";
  EXPECT_EQ(session.status().state, LinkState::armed);
  EXPECT_EQ(session.status().problem, "");
}

TEST_F(LegacySessionTest, TellsThatNothingIsKnownOfTheJacket) {
  start();
  EXPECT_FALSE(session.status().answers);
  EXPECT_FALSE(session.status().telemetry);
  EXPECT_EQ(session.status().firmware_version, 0);
  EXPECT_EQ(session.status().frames_received, 0U);
}

TEST_F(LegacySessionTest, StartsAPulseWithTheMotorsNumberAsABareByte) {
  start();
  EXPECT_TRUE(send({{0, 255, 100ms}, {15, 1, 100ms}, {7, 0, 100ms}}));
  EXPECT_THAT(said(), ElementsAre(1, 16));
  EXPECT_THAT(said(), IsEmpty());
  EXPECT_EQ(session.status().frames_sent, 1U);
}

TEST_F(LegacySessionTest, KeepsADriveUpWithAByteEvery200MillisecondsAtMost) {
  start();
  std::vector<Timestamp> times;
  const Timestamp end = clock.now() + 2s;
  while (clock.now() < end) {
    send({{4, 255, 150ms}});
    if (!said().empty()) times.push_back(clock.now());
    clock.advance(5ms);
  }
  EXPECT_EQ(times.size(), 10U);
  for (std::size_t i = 1; i < times.size(); ++i)
    EXPECT_EQ(times[i] - times[i - 1], 200ms);
}

TEST_F(LegacySessionTest, StartsNoPulseThatWouldOutlastItsDriveByMoreThanOneDoesAnyway) {
  start();
  send({{4, 255, 240ms}});
  EXPECT_THAT(said(), ElementsAre(5));
  for (int ms = 0; ms < 600; ms += 5) {
    clock.advance(5ms);
    EXPECT_THAT(said(), IsEmpty()) << "the first pulse of 250 ms outlasts it at " << ms << " ms";
  }
}

TEST_F(LegacySessionTest, LeavesAMotorThatAStateDoesNotNameToItsPulsesEnd) {
  start();
  send({{4, 255, 1s}});
  EXPECT_THAT(said(), ElementsAre(5));
  send({});
  clock.advance(1s);
  EXPECT_THAT(said(), IsEmpty());
  send({{4, 255, 1s}});
  EXPECT_THAT(said(), ElementsAre(5));
  session.stop_all();
  clock.advance(220ms);
  EXPECT_THAT(said(), IsEmpty());
}

TEST_F(LegacySessionTest, NeverRunsAMotorLongerThan250MillisecondsAfterItsDrivesEnd) {
  start();
  std::uint32_t random = 12345;
  const auto next = [&random](std::uint32_t below) { return (random = random * 1664525 + 1013904223) / 65536 % below; };
  std::map<std::uint8_t, Timestamp> drive_end;
  std::map<std::uint8_t, Timestamp> pulse_begin;
  for (int ms = 0; ms < 20'000; ++ms) {
    if (next(40) == 0) {
      MotorCommands state;
      for (auto& [channel, end] : drive_end)
        end = std::min(end, clock.now());
      for (std::uint8_t channel = 0; channel < 16; ++channel) {
        if (next(3) != 0) continue;
        const Duration duration = std::chrono::milliseconds(1 + next(250));
        state.push_back({channel, 200, duration});
        drive_end[channel] = clock.now() + duration;
      }
      send(state);
    }
    for (const std::uint8_t byte : said()) {
      const auto channel = static_cast<std::uint8_t>(byte - 1);
      ASSERT_TRUE(drive_end.contains(channel));
      ASSERT_GT(drive_end[channel], clock.now()) << "it was asked for";
      if (pulse_begin.contains(channel)) {
        ASSERT_GE(clock.now() - pulse_begin[channel], 200ms);
      }
      pulse_begin[channel] = clock.now();
    }
    clock.advance(1ms);
  }
  EXPECT_THAT(pulse_begin.size(), Ge(16U));
}

TEST_F(LegacySessionTest, HeatsNothingAndKnowsNoOtherMotors) {
  start();
  EXPECT_FALSE(session.heat({{0, 36, 200ms}}, clock.now()));
  EXPECT_TRUE(send({{16, 255, 200ms}, {200, 255, 200ms}}));
  EXPECT_THAT(said(), IsEmpty());
}

TEST_F(LegacySessionTest, WaitsWhileTheWireHasABacklog) {
  start();
  send({{4, 255, 200ms}});
  EXPECT_THAT(said(true), IsEmpty());
  clock.advance(150ms);
  EXPECT_THAT(said(false), ElementsAre(5));
  clock.advance(20ms);
  send({{9, 255, 50ms}});
  EXPECT_THAT(said(true), IsEmpty());
  clock.advance(50ms);
  EXPECT_THAT(said(false), IsEmpty()) << "its time is over";
}

TEST_F(LegacySessionTest, BelievesNothingThatItHears) {
  start();
  session.receive(std::vector<std::uint8_t>{1, 2, 0, 0, 255}, clock.now());
  EXPECT_EQ(session.status().malformed_frames, 0U);
  EXPECT_THAT(said(), IsEmpty());
}

TEST_F(LegacySessionTest, WaitsAgainAfterTheWireWasLost) {
  start();
  send({{4, 255, 10s}});
  session.disconnected();
  EXPECT_EQ(session.status().state, LinkState::absent);
  EXPECT_THAT(said(), IsEmpty());
  start();
  EXPECT_EQ(session.status().reconnects, 1U);
}

}  // namespace
}  // namespace telehug
