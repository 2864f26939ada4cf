// SPDX-License-Identifier: Apache-2.0
//
// Heaters and telemetry in the conversation with the jacket.
#include <limits>

#include "unit/link/jacket_session_fixture.hpp"

namespace telehug {
namespace {

using protocol::FrameType;
using protocol::HeaterFault;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

// A jacket of 12 motors and 2 heaters.
class HeatedSessionTest : public JacketSessionTest {
 protected:
  HeatedSessionTest() { arm(12, 2); }

  void hear_telemetry(const FramePayload& temperatures) {
    FramePayload payload{1, 0, 7, 0, 1, 1, 4, 1, 0, 0, 0xEC, 0x13};  // 7 malformed, 257 overrun, brown-out, 5100 mV
    payload.insert(payload.end(), temperatures.begin(), temperatures.end());
    hear({FrameType::telemetry, 9, payload});
  }
};

TEST_F(HeatedSessionTest, KnowsHowManyMotorsAndHeatersTheJacketHas) {
  EXPECT_EQ(session.status().motor_count, 12);
  EXPECT_EQ(session.status().heater_count, 2);
}

TEST_F(HeatedSessionTest, HeatsInTenthsOfADegreeRoundedDown) {
  EXPECT_TRUE(heat({{0, 37.9, 199ms}, {1, 40.0, 10s}}));
  const auto frames = said();
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_EQ(frames[0].type, FrameType::heat);
  EXPECT_THAT(frames[0].payload, ElementsAre(0, 379 & 0xFF, 379 >> 8, 19, 1, 400 & 0xFF, 400 >> 8, 25));
  clock.advance(30ms);
  heat({{0, 33.19, 200ms}});
  EXPECT_THAT(said().at(0).payload, ElementsAre(0, 331 & 0xFF, 331 >> 8, 20));
}

TEST_F(HeatedSessionTest, SendsNothingOfACommandThatIsTooWarmOrNoNumber) {
  for (const double celsius :
       {40.01, 41.0, 1e9, -0.1, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    EXPECT_FALSE(heat({{0, 36, 200ms}, {1, celsius, 200ms}})) << celsius;
    EXPECT_THAT(said(), IsEmpty()) << celsius;
  }
}

TEST_F(HeatedSessionTest, LeavesHeatersThatItDoesNotNameAsTheyAre) {
  heat({{0, 36, 200ms}, {1, 36, 200ms}});
  (void)said();
  clock.advance(30ms);
  heat({{1, 37, 200ms}});
  EXPECT_THAT(said().at(0).payload, ElementsAre(1, 370 & 0xFF, 370 >> 8, 20));
}

TEST_F(HeatedSessionTest, SendsOnlyTheNewestOfWhatHadToWait) {
  heat({{0, 36, 200ms}});
  (void)said();
  clock.advance(5ms);
  heat({{0, 37, 200ms}});
  heat({{0, 38, 100ms}});
  EXPECT_THAT(said(), IsEmpty());
  clock.advance(15ms);
  EXPECT_THAT(said().at(0).payload, ElementsAre(0, 380 & 0xFF, 380 >> 8, 8)) << "shortened by what it waited";
}

TEST_F(HeatedSessionTest, LetsLessWarmthGoAtOnce) {
  heat({{0, 38, 200ms}, {1, 38, 200ms}});
  (void)said();
  clock.advance(1ms);
  heat({{0, 36, 200ms}, {1, 0, 200ms}});
  EXPECT_THAT(said().at(0).payload, ElementsAre(0, 360 & 0xFF, 360 >> 8, 20, 1, 0, 0, 0));
}

TEST_F(HeatedSessionTest, DoesNotTurnOffAHeaterThatIsOff) {
  heat({{0, 0, 200ms}});
  EXPECT_THAT(said(), IsEmpty());
  heat({{0, 38, 50ms}});
  (void)said();
  clock.advance(60ms);
  heat({{0, 0, 200ms}});
  EXPECT_THAT(said(), IsEmpty()) << "its time is over";
}

TEST_F(HeatedSessionTest, NamesNoHeaterThatTheJacketLacks) {
  EXPECT_TRUE(heat({{0, 36, 200ms}, {7, 36, 200ms}}));
  EXPECT_THAT(said().at(0).payload, ElementsAre(0, 360 & 0xFF, 360 >> 8, 20));
}

TEST_F(HeatedSessionTest, StopsHeatThatHasNotLeftWithEverythingElse) {
  send({{3, 255, 200ms}});
  heat({{0, 36, 200ms}});
  session.stop_all();
  EXPECT_THAT(types_said(), ElementsAre(FrameType::stop_all));
  clock.advance(30ms);
  EXPECT_THAT(said(), IsEmpty());
}

TEST_F(HeatedSessionTest, TurnsTheLastMotorOffWithoutStoppingTheHeaters) {
  send({{3, 255, 200ms}});
  (void)said();
  clock.advance(25ms);
  heat({{0, 36, 200ms}});
  (void)said();
  clock.advance(1ms);
  send({});
  const auto frames = said();
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_EQ(frames[0].type, FrameType::set);
  EXPECT_THAT(frames[0].payload, ElementsAre(3, 0, 0));
}

TEST_F(HeatedSessionTest, StopsEverythingInOneFrameOnceNoHeaterRunsAnyMore) {
  send({{3, 255, 200ms}});
  heat({{0, 36, 40ms}});
  (void)said();
  clock.advance(20ms);
  (void)said();
  clock.advance(60ms);
  send({});
  EXPECT_THAT(types_said(), ElementsAre(FrameType::stop_all));
}

TEST_F(HeatedSessionTest, DoesNotRepeatAStopIntoNewHeat) {
  session.stop_all();
  (void)said();
  heat({{0, 36, 200ms}});
  EXPECT_THAT(types_said(), ElementsAre(FrameType::heat));
  clock.advance(60ms);
  EXPECT_THAT(said(), IsEmpty());
}

TEST_F(HeatedSessionTest, GivesMotorsAndHeatersTheirTurnsAlternately) {
  int sets = 0;
  int heats = 0;
  for (int ms = 0; ms < 1000; ++ms) {
    send({{3, static_cast<std::uint8_t>(50 + ms / 20), 200ms}});
    heat({{0, 33 + ms / 1000.0, 200ms}});
    for (const Frame& frame : said()) {
      acknowledge(frame);
      sets += frame.type == FrameType::set ? 1 : 0;
      heats += frame.type == FrameType::heat ? 1 : 0;
    }
    clock.advance(1ms);
  }
  EXPECT_GE(sets, 22);
  EXPECT_GE(heats, 22);
  EXPECT_LE(sets + heats, 50);
}

TEST_F(HeatedSessionTest, SendsAtMostFiftyFramesASecondEvenIfEachAsksForLess) {
  std::vector<Timestamp> left;
  for (int ms = 0; ms < 3000; ++ms) {
    const int down = ms % 200;
    send({{3, static_cast<std::uint8_t>(255 - down), 250ms}});
    heat({{0, 39.9 - down / 50.0, 250ms}});
    for (const Frame& frame : said()) {
      acknowledge(frame);
      if (frame.type == FrameType::set || frame.type == FrameType::heat) left.push_back(clock.now());
    }
    clock.advance(1ms);
  }
  for (std::size_t last = 50; last < left.size(); ++last)
    ASSERT_GE(left[last] - left[last - 50], 1s) << "51 frames within a second";
  EXPECT_GE(left.size(), 120U);
}

TEST_F(HeatedSessionTest, AsksForTelemetryTwiceASecondAndOnlyWhereTheWireHasRoom) {
  int asked = 0;
  for (int ms = 0; ms <= 2000; ms += 10) {
    for (const Frame& frame : said()) {
      acknowledge(frame);
      asked += frame.type == FrameType::status ? 1 : 0;
    }
    clock.advance(10ms);
  }
  EXPECT_EQ(asked, 4);
  clock.advance(500ms);
  hear({FrameType::ack, 1, {2}});
  EXPECT_THAT(said(true), IsEmpty());
  EXPECT_THAT(types_said(false), ElementsAre(FrameType::status));
}

TEST_F(HeatedSessionTest, ReadsWhatTheJacketTellsOfItself) {
  EXPECT_FALSE(session.status().telemetry);
  hear_telemetry({365 & 0xFF, 365 >> 8, 0, 0x00, 0x80, 1});
  const auto& telemetry = session.status().telemetry;
  ASSERT_TRUE(telemetry);
  EXPECT_EQ(telemetry->heard, clock.now());
  EXPECT_DOUBLE_EQ(telemetry->supply_volts, 5.1);
  EXPECT_EQ(telemetry->reset_cause, 4);
  EXPECT_EQ(telemetry->frames_malformed, 7);
  EXPECT_EQ(telemetry->bytes_overrun, 257);
  ASSERT_EQ(telemetry->heaters.size(), 2U);
  EXPECT_DOUBLE_EQ(telemetry->heaters[0].celsius.value(), 36.5);
  EXPECT_EQ(telemetry->heaters[0].fault, HeaterFault::none);
  EXPECT_EQ(telemetry->heaters[1].celsius, std::nullopt);
  EXPECT_EQ(telemetry->heaters[1].fault, HeaterFault::sensor_open);
}

TEST_F(HeatedSessionTest, KeepsAFaultThatItDoesNotKnowAndNoTemperatureThatCannotBe) {
  hear_telemetry({1501 & 0xFF, 1501 >> 8, 99, static_cast<std::uint8_t>(-401 & 0xFF), 0xFE, 0});
  ASSERT_TRUE(session.status().telemetry);
  EXPECT_EQ(session.status().telemetry->heaters[0].celsius, std::nullopt);
  EXPECT_EQ(session.status().telemetry->heaters[0].fault, static_cast<HeaterFault>(99));
  EXPECT_EQ(session.status().telemetry->heaters[1].celsius, std::nullopt);
  hear_telemetry({1500 & 0xFF, 1500 >> 8, 0, static_cast<std::uint8_t>(-400 & 0xFF), 0xFE, 0});
  EXPECT_DOUBLE_EQ(session.status().telemetry->heaters[0].celsius.value(), 150);
  EXPECT_DOUBLE_EQ(session.status().telemetry->heaters[1].celsius.value(), -40);
}

TEST_F(HeatedSessionTest, BelievesNoTelemetryOfAnotherNumberOfTemperatures) {
  hear_telemetry({});
  hear_telemetry({1, 0, 0});
  hear_telemetry({1, 0, 0, 1, 0});
  hear_telemetry({1, 0, 0, 1, 0, 0, 1, 0, 0});
  EXPECT_FALSE(session.status().telemetry);
  EXPECT_EQ(session.status().malformed_frames, 4U);
}

TEST_F(HeatedSessionTest, ForgetsWhatAJacketThatHasGoneTold) {
  hear_telemetry({1, 0, 0, 1, 0, 0});
  ASSERT_TRUE(session.status().telemetry);
  session.disconnected();
  EXPECT_FALSE(session.status().telemetry);
}

TEST_F(JacketSessionTest, HeatsNothingWithoutAnArmedJacketThatCan) {
  EXPECT_FALSE(heat({{0, 36, 200ms}}));
  arm();
  EXPECT_FALSE(heat({{0, 36, 200ms}})) << "it has no heater";
  EXPECT_THAT(said(), IsEmpty());
}

TEST_F(JacketSessionTest, CountsNoHeaterWithoutASensor) {
  session.connected(clock.now());
  for (const Frame& frame : said()) {
    if (frame.type == FrameType::hello) {
      hear({FrameType::caps,
            frame.sequence,
            {1, 1, 12, 2, 1, 32, 64, 50, 25, 1, frame.payload.at(2), frame.payload.at(3)}});
    }
  }
  ASSERT_TRUE(session.armed());
  EXPECT_EQ(session.status().heater_count, 1);
}

TEST_F(JacketSessionTest, StaysOffWithAJacketOfMoreHeatersThanItKnows) {
  session.connected(clock.now());
  answer(said(), 1, 16, 3);
  EXPECT_FALSE(session.armed());
  EXPECT_THAT(session.status().problem, ::testing::HasSubstr("3 heaters"));
}

}  // namespace
}  // namespace telehug
