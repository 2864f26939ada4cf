// SPDX-License-Identifier: Apache-2.0
//
// The link's supervisor on a fake clock, with the protocol's conversation on a pair of sockets as of any connection.
#include "link/wire_link.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "doubles/allocation_counter.hpp"
#include "doubles/fake_clock.hpp"
#include "doubles/scripted_opener.hpp"
#include "link/jacket_session.hpp"

namespace telehug {
namespace {

using protocol::FrameType;
using ::testing::ElementsAre;

class WireLinkTest : public ::testing::Test {
 protected:
  void poll() { link.poll(clock.now()); }

  // Polls as the drive thread does.
  void run(Duration duration) {
    for (const Timestamp end = clock.now() + duration; clock.now() < end;) {
      poll();
      clock.advance(10ms);
    }
  }
  // Likewise, with a jacket that answers.
  std::vector<Frame> run_answered(Duration duration) {
    std::vector<Frame> all;
    for (const Timestamp end = clock.now() + duration; clock.now() < end;) {
      poll();
      for (const Frame& frame : said()) {
        answer(frame);
        all.push_back(frame);
      }
      poll();
      clock.advance(10ms);
    }
    return all;
  }

  std::vector<Frame> said() {
    std::vector<Frame> frames;
    if (!far.wire) return frames;
    for (const std::uint8_t byte : far.wire->read())
      if (auto frame = decoder.push(byte)) frames.push_back(*frame);
    return frames;
  }
  void say(const Frame& frame) const {
    const EncodedFrame bytes = encode(frame);
    far.wire->write({bytes.data(), bytes.size()});
  }
  void answer(const Frame& frame) const {
    if (frame.type == FrameType::hello) {
      say({FrameType::caps,
           frame.sequence,
           {1, 1, 12, 2, 2, 32, 64, 50, 25, 1, frame.payload.at(2), frame.payload.at(3)}});
    } else if (frame.type == FrameType::status) {
      say({FrameType::telemetry, frame.sequence, {1, 0, 0, 0, 0, 0, 1, 1, 0, 0, 0x88, 0x13, 1, 1, 0, 1, 1, 0}});
    } else {
      say({FrameType::ack, frame.sequence, {static_cast<std::uint8_t>(frame.type)}});
    }
  }
  void arm() {
    far.answer = FarEnd::Answer::wire;
    for (int i = 0; i < 600 && link.status().state != LinkState::armed; ++i)
      (void)run_answered(10ms);
    ASSERT_EQ(link.status().state, LinkState::armed);
  }

  FakeClock clock;
  FarEnd far;
  WireLink link{std::make_unique<ScriptedOpener>(far), std::make_unique<JacketSession>()};
  FrameDecoder decoder;
};

TEST_F(WireLinkTest, TriesAgainAfterPausesThatGrowFrom200MillisecondsTo5Seconds) {
  far.answer = FarEnd::Answer::error;
  run(30s);
  std::vector<std::int64_t> pauses_ms;
  for (std::size_t i = 1; i < far.asked.size(); ++i)
    pauses_ms.push_back((far.asked[i] - far.asked[i - 1]) / 1ms);
  EXPECT_THAT(pauses_ms, ElementsAre(200, 400, 800, 1600, 3200, 5000, 5000, 5000, 5000));
  EXPECT_EQ(link.status().state, LinkState::absent);
  EXPECT_EQ(link.status().problem, "there is none; make one");
}

TEST_F(WireLinkTest, TriesAgainSoonOnceAJacketHadAnswered) {
  far.answer = FarEnd::Answer::error;
  run(10s);
  arm();
  far.answer = FarEnd::Answer::error;
  far.wire->close_own();
  far.asked.clear();
  const Timestamp lost = clock.now();
  run(1s);
  ASSERT_EQ(far.asked.size(), 2U);
  EXPECT_EQ(far.asked[0] - lost, 200ms);
  EXPECT_EQ(far.asked[1] - lost, 600ms);
}

TEST_F(WireLinkTest, GoesOnPausingForAWireOnWhichNobodyAnswers) {
  run(100ms);
  far.asked.clear();
  far.wire->close_own();
  run(250ms);
  far.wire->close_own();
  run(450ms);
  ASSERT_EQ(far.asked.size(), 2U);
  EXPECT_EQ(far.asked[1] - far.asked[0], 450ms) << "400 ms after it was lost again";
}

TEST_F(WireLinkTest, AsksAnOpenerThatIsAtItAgainWithEveryPoll) {
  far.answer = FarEnd::Answer::later;
  run(100ms);
  EXPECT_EQ(far.asked.size(), 10U);
  EXPECT_EQ(link.status().state, LinkState::absent);
  EXPECT_EQ(link.status().problem, "getting there");
  arm();
}

TEST_F(WireLinkTest, TurnsEverythingOffWithTheFirstBytesOnEveryWire) {
  for (int connection = 0; connection < 5; ++connection) {
    run(250ms);
    const auto bytes = far.wire->read();
    ASSERT_GT(bytes.size(), 7U);
    EXPECT_EQ(bytes[0], 0) << "ends what an earlier host left unfinished";
    EXPECT_EQ(bytes[2], static_cast<std::uint8_t>(FrameType::stop_all));
    far.wire->close_own();
    far.answer = FarEnd::Answer::wire;
    run(5s);
  }
}

TEST_F(WireLinkTest, TellsThatTheWireIsLostAndForgetsWhatItWasToDrive) {
  arm();
  EXPECT_TRUE(link.send({{3, 255, 200ms}}, clock.now()));
  far.answer = FarEnd::Answer::error;
  far.wire->close_own();
  poll();
  EXPECT_EQ(link.status().state, LinkState::absent);
  EXPECT_EQ(link.status().problem, "the connection to far end is lost: mend it");
  EXPECT_FALSE(link.send({{3, 255, 200ms}}, clock.now()));
  EXPECT_FALSE(link.heat({{0, 36, 200ms}}, clock.now()));
  far.answer = FarEnd::Answer::wire;
  for (const Frame& frame : run_answered(1s))
    EXPECT_NE(frame.type, FrameType::set);
  EXPECT_EQ(link.status().state, LinkState::armed);
  EXPECT_EQ(link.status().reconnects, 1U);
}

TEST_F(WireLinkTest, DropsAFrameThatHadNotLeftWhenTheWireBroke) {
  arm();
  const auto sent = [this] { return link.status().frames_sent; };
  // Nobody reads. Stops leave until the wire is full; from then on one of them waits.
  for (auto before = sent() - 1; sent() != before;) {
    before = sent();
    link.stop_all(clock.now());
    ASSERT_LT(sent(), 100'000U);
  }
  far.wire->close_own();
  poll();
  ASSERT_EQ(link.status().state, LinkState::absent);
  clock.advance(200ms);
  poll();
  const auto bytes = far.wire->read();
  ASSERT_GT(bytes.size(), 7U);
  EXPECT_EQ(bytes[0], 0) << "what opens a connection, not what an earlier one had left over";
  EXPECT_EQ(bytes[2], static_cast<std::uint8_t>(FrameType::stop_all));
}

TEST_F(WireLinkTest, ForgetsTheHalfOfAFrameInWhoseMiddleTheWireBroke) {
  arm();
  const EncodedFrame acknowledgement = encode({FrameType::ack, 1, {2}});
  far.wire->write({acknowledgement.data(), 4});
  poll();
  far.wire->close_own();
  poll();
  ASSERT_EQ(link.status().state, LinkState::absent);
  (void)run_answered(300ms);
  EXPECT_EQ(link.status().state, LinkState::armed);
  EXPECT_EQ(link.status().malformed_frames, 0U) << "the half was not taken for the beginning of the next one";
}

TEST_F(WireLinkTest, KeepsTheJacketAliveAndGreetsAgainWhenItFallsSilent) {
  arm();
  const auto frames = run_answered(2s);
  EXPECT_GE(frames.size(), 19U) << "something at least every 100 ms";
  run(900ms);
  EXPECT_EQ(link.status().state, LinkState::armed) << "the jacket may be silent for a second";
  run(200ms);
  EXPECT_EQ(link.status().state, LinkState::connecting);
  EXPECT_EQ(far.asked.size(), 1U) << "on the same wire: another one would reset the jacket";
  (void)run_answered(300ms);
  EXPECT_EQ(link.status().state, LinkState::armed);
}

TEST_F(WireLinkTest, LetsNothingPileUpForAJacketThatDoesNotRead) {
  arm();
  (void)said();
  for (int ms = 0; ms < 800; ms += 10) {
    link.send({{3, static_cast<std::uint8_t>(100 + ms / 10), 250ms}}, clock.now());
    say({FrameType::ack, 0, {2}});  // it lives
    poll();
    clock.advance(10ms);
  }
  EXPECT_LE(said().size(), 4U) << "three frames count as a backlog";
  link.send({{3, 250, 250ms}}, clock.now());
  poll();
  const auto frames = said();
  ASSERT_FALSE(frames.empty());
  EXPECT_EQ(frames.front().type, FrameType::set);
  EXPECT_THAT(frames.front().payload, ElementsAre(3, 250, 25)) << "the newest";
}

TEST_F(WireLinkTest, LetsAStopPassABacklog) {
  arm();
  for (int ms = 0; ms < 300; ms += 10) {
    link.send({{3, static_cast<std::uint8_t>(100 + ms / 10), 250ms}}, clock.now());
    poll();
    clock.advance(10ms);
  }
  link.stop_all(clock.now());
  const auto frames = said();
  ASSERT_FALSE(frames.empty());
  EXPECT_EQ(frames.back().type, FrameType::stop_all);
}

TEST_F(WireLinkTest, IsNotHeldUpByAJacketThatNeverStopsTalking) {
  arm();
  const std::vector<std::uint8_t> noise(100'000, 0x55);
  far.wire->write(noise);
  poll();
  link.stop_all(clock.now());
  EXPECT_THAT(said().back().type, FrameType::stop_all);
}

TEST_F(WireLinkTest, AllocatesNothingWhileTheJacketIsDriven) {
  if (!allocations_are_counted()) GTEST_SKIP() << "the sanitizer has a heap of its own";
  arm();
  // Everything that the jacket will answer, made before it is counted.
  std::array<EncodedFrame, 256> acknowledgements;
  for (std::size_t sequence = 0; sequence < acknowledgements.size(); ++sequence)
    acknowledgements.at(sequence) = encode({FrameType::ack, static_cast<std::uint8_t>(sequence), {2}});
  const std::uint64_t before = allocation_count();
  std::size_t answered = 0;
  for (int ms = 0; ms < 5000; ms += 5) {
    link.send({{3, static_cast<std::uint8_t>(ms % 200), 200ms}, {9, 80, 150ms}}, clock.now());
    link.heat({{0, 36.5, 200ms}}, clock.now());
    link.poll(clock.now());
    far.wire->drain();
    const EncodedFrame& acknowledgement = acknowledgements.at(answered++ % acknowledgements.size());
    far.wire->write({acknowledgement.data(), acknowledgement.size()});
    clock.advance(5ms);
  }
  EXPECT_EQ(allocation_count() - before, 0U);
  EXPECT_EQ(link.status().state, LinkState::armed);
}

}  // namespace
}  // namespace telehug
