// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "unit/link/jacket_session_fixture.hpp"

namespace telehug {
namespace {

using protocol::FrameType;
using protocol::NackReason;
using ::testing::AnyOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST_F(JacketSessionTest, SaysNothingWithoutAWire) {
  EXPECT_THAT(said(), IsEmpty());
  EXPECT_FALSE(send({{1, 255, 100ms}}));
  session.stop_all();
  EXPECT_THAT(said(), IsEmpty());
}

TEST_F(JacketSessionTest, TurnsEverythingOffBeforeItSaysHello) {
  session.connected(clock.now());
  const EncodedFrame first = session.next_frame(clock.now(), false);
  ASSERT_EQ(first.size(), 7U);
  EXPECT_EQ(first.front(), 0) << "flushes what an earlier host left unfinished";
  EXPECT_EQ(first.at(2), static_cast<std::uint8_t>(FrameType::stop_all));
  EXPECT_THAT(types_said(), ElementsAre(FrameType::hello));
}

TEST_F(JacketSessionTest, SaysHelloEvery200MillisecondsUntilItIsAnswered) {
  session.connected(clock.now());
  (void)said();
  clock.advance(199ms);
  EXPECT_THAT(said(), IsEmpty());
  clock.advance(1ms);
  const auto second = said();
  ASSERT_EQ(second.size(), 1U);
  EXPECT_EQ(second[0].type, FrameType::hello);
  answer(second);
  EXPECT_TRUE(session.armed());
  EXPECT_EQ(session.status().state, LinkState::armed);
  EXPECT_EQ(session.status().motor_count, 16);
  EXPECT_EQ(session.status().problem, "");
}

TEST_F(JacketSessionTest, TellsAfterThreeSecondsThatNobodyAnswers) {
  session.connected(clock.now());
  for (int i = 0; i < 16; ++i) {
    (void)said();
    clock.advance(200ms);
  }
  EXPECT_THAT(types_said(), ElementsAre(FrameType::hello));
  EXPECT_THAT(session.status().problem, HasSubstr("does not answer"));
  EXPECT_EQ(session.status().state, LinkState::connecting);
}

TEST_F(JacketSessionTest, BelievesNoAnswerToAnotherHello) {
  session.connected(clock.now());
  auto hello = said().back();
  hello.payload.at(2) ^= 1;
  answer({hello});
  EXPECT_FALSE(session.armed());
}

TEST_F(JacketSessionTest, StaysOffWithAJacketOfAnotherVersion) {
  session.connected(clock.now());
  answer(said(), 2);
  EXPECT_FALSE(session.armed());
  EXPECT_THAT(session.status().problem, HasSubstr("update its firmware"));
  clock.advance(4s);
  hear_nack(NackReason::bad_version);
  (void)said();
  EXPECT_THAT(session.status().problem, HasSubstr("update it"));
  EXPECT_FALSE(send({{1, 255, 100ms}}));
}

TEST_F(JacketSessionTest, KeepsTheJacketAliveEvery100Milliseconds) {
  arm();
  int keeps = 0;
  for (int ms = 0; ms < 1000; ms += 10) {
    for (const Frame& frame : said()) {
      EXPECT_THAT(frame.type, AnyOf(FrameType::keep, FrameType::status));
      acknowledge(frame);
      ++keeps;
    }
    clock.advance(10ms);
  }
  EXPECT_GE(keeps, 9);
  EXPECT_LE(keeps, 11);
}

TEST_F(JacketSessionTest, SendsAStateInOneFrameWithDurationsRoundedDownAndCut) {
  arm();
  EXPECT_TRUE(send({{3, 255, 99ms}, {7, 1, 10s}}));
  const auto frames = said();
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_EQ(frames[0].type, FrameType::set);
  EXPECT_THAT(frames[0].payload, ElementsAre(3, 255, 9, 7, 1, 25));
}

TEST_F(JacketSessionTest, TurnsOffWhatTheNewStateDoesNotName) {
  arm();
  send({{3, 255, 200ms}, {7, 100, 200ms}});
  (void)said();
  clock.advance(20ms);
  send({{7, 100, 200ms}});
  const auto frames = said();
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_THAT(frames[0].payload, ElementsAre(3, 0, 0, 7, 100, 20));
}

TEST_F(JacketSessionTest, DoesNotMentionAMotorWhoseTimeIsOver) {
  arm();
  send({{3, 255, 50ms}});
  (void)said();
  clock.advance(60ms);
  send({{7, 100, 200ms}});
  EXPECT_THAT(said().at(0).payload, ElementsAre(7, 100, 20));
}

TEST_F(JacketSessionTest, SendsAtMostFiftyStatesASecondAndAlwaysTheNewest) {
  arm();
  int sets = 0;
  for (int ms = 0; ms < 1000; ms += 2) {
    send({{3, static_cast<std::uint8_t>(100 + ms / 20), 200ms}});
    for (const Frame& frame : said()) {
      acknowledge(frame);
      if (frame.type != FrameType::set) continue;
      ++sets;
      EXPECT_EQ(frame.payload.at(1), 100 + ms / 20);
    }
    clock.advance(2ms);
  }
  EXPECT_GE(sets, 45);
  EXPECT_LE(sets, 50);
}

TEST_F(JacketSessionTest, ShortensAStateThatHadToWait) {
  arm();
  send({{3, 100, 200ms}});
  (void)said();
  clock.advance(5ms);
  send({{3, 200, 100ms}});
  EXPECT_THAT(said(), IsEmpty());
  clock.advance(15ms);
  EXPECT_THAT(said().at(0).payload, ElementsAre(3, 200, 8));
}

TEST_F(JacketSessionTest, LetsAWeakerStateGoAtOnce) {
  arm();
  send({{3, 200, 200ms}});
  (void)said();
  clock.advance(1ms);
  send({{3, 100, 200ms}});
  EXPECT_THAT(said().at(0).payload, ElementsAre(3, 100, 20));
}

TEST_F(JacketSessionTest, LetsAStateWithoutAnyMotorGoAtOnceAsAStop) {
  arm();
  send({{3, 200, 200ms}});
  (void)said();
  clock.advance(1ms);
  send({});
  EXPECT_THAT(types_said(), ElementsAre(FrameType::stop_all));
  send({});
  EXPECT_THAT(said(), IsEmpty()) << "nothing runs: nothing to say";
}

TEST_F(JacketSessionTest, SendsOnlyStopsWhileTheWireHasABacklog) {
  arm();
  send({{3, 200, 200ms}});
  EXPECT_THAT(said(true), IsEmpty());
  session.stop_all();
  EXPECT_THAT(types_said(true), ElementsAre(FrameType::stop_all));
  EXPECT_THAT(said(false), IsEmpty()) << "the stop has taken the waiting state's place";
}

TEST_F(JacketSessionTest, HoldsStatesBackWhileTheJacketAnswersNothing) {
  arm();
  std::vector<Frame> frames;
  for (int ms = 0; ms < 800; ms += 10) {
    send({{3, static_cast<std::uint8_t>(100 + ms / 10), 250ms}});
    for (const Frame& frame : said())
      frames.push_back(frame);
    clock.advance(10ms);
  }
  const auto sets = std::ranges::count(frames, FrameType::set, &Frame::type);
  EXPECT_EQ(sets, 4) << "one every 20 ms for 70 ms";
  EXPECT_THAT(frames.back().type, AnyOf(FrameType::keep, FrameType::status)) << "the jacket is kept alive, though";
  session.stop_all();
  EXPECT_THAT(types_said(), ElementsAre(FrameType::stop_all)) << "stops always leave";
  send({{3, 250, 250ms}});
  EXPECT_THAT(said(), IsEmpty());
  acknowledge(frames.back());
  const auto newest = said();
  ASSERT_EQ(newest.size(), 1U);
  EXPECT_THAT(newest[0].payload, ElementsAre(3, 250, 25));
}

TEST_F(JacketSessionTest, HoldsNoStateBackThatTurnsEverythingOff) {
  arm();
  send({{3, 200, 250ms}});
  EXPECT_THAT(types_said(), ElementsAre(FrameType::set));
  clock.advance(90ms);
  send({{3, 100, 250ms}});
  EXPECT_THAT(said(), IsEmpty()) << "the jacket is silent";
  send({});
  EXPECT_THAT(types_said(), ElementsAre(FrameType::stop_all));
}

TEST_F(JacketSessionTest, RepeatsAStopUntilItIsAcknowledged) {
  arm();
  session.stop_all();
  auto frames = said();
  ASSERT_EQ(frames.size(), 1U);
  clock.advance(50ms);
  frames = said();
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_EQ(frames[0].type, FrameType::stop_all);
  acknowledge(frames[0]);
  clock.advance(50ms);
  EXPECT_THAT(said(), IsEmpty());
}

TEST_F(JacketSessionTest, DoesNotRepeatAStopIntoANewDrive) {
  arm();
  session.stop_all();
  (void)said();
  send({{3, 200, 200ms}});
  EXPECT_THAT(types_said(), ElementsAre(FrameType::set));
  clock.advance(60ms);
  EXPECT_THAT(said(), IsEmpty());
}

TEST_F(JacketSessionTest, SaysHelloAgainWhenTheJacketHasDisarmedItself) {
  arm();
  hear_nack(NackReason::unarmed);
  EXPECT_FALSE(session.armed());
  EXPECT_FALSE(send({{3, 200, 200ms}}));
  const auto frames = said();
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_EQ(frames[0].type, FrameType::hello);
  answer(frames);
  EXPECT_TRUE(session.armed());
  EXPECT_EQ(session.status().reconnects, 1U);
  EXPECT_EQ(session.status().nacks, 1U);
}

TEST_F(JacketSessionTest, ConnectsAgainAfterASecondOfSilence) {
  arm();
  for (int i = 0; i < 9; ++i) {
    clock.advance(100ms);
    (void)said();
  }
  EXPECT_TRUE(session.armed());
  clock.advance(200ms);
  EXPECT_THAT(types_said(), ElementsAre(FrameType::hello));
  EXPECT_EQ(session.status().state, LinkState::connecting);
}

TEST_F(JacketSessionTest, ForgetsAStateThatHasNotLeftWhenTheWireGoes) {
  arm();
  send({{3, 200, 200ms}});
  session.disconnected();
  EXPECT_EQ(session.status().state, LinkState::absent);
  session.connected(clock.now());
  answer(said());
  EXPECT_THAT(types_said(), ElementsAre(FrameType::status));
}

TEST_F(JacketSessionTest, CountsWhatIsNoAnswer) {
  arm();
  const std::vector<std::uint8_t> garbage{1, 2, 3, 0, 9, 9, 0};
  session.receive(garbage, clock.now());
  hear({FrameType::set, 1, {1, 2, 3}});
  hear({FrameType::ack, 1, {}});
  EXPECT_EQ(session.status().malformed_frames, 4U);
  EXPECT_TRUE(session.armed());
}

TEST_F(JacketSessionTest, NamesNoMotorThatTheJacketLacks) {
  session.connected(clock.now());
  answer(said(), 1, 8);
  ASSERT_TRUE(session.armed());
  clock.advance(20ms);
  send({{7, 200, 200ms}, {8, 200, 200ms}, {200, 200, 200ms}});
  EXPECT_THAT(said().at(0).payload, ElementsAre(7, 200, 20));
}

}  // namespace
}  // namespace telehug
