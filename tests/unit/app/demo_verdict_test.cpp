// SPDX-License-Identifier: Apache-2.0
#include "demo_verdict.hpp"

#include <gmock/gmock.h>

#include "unit/jacket/jacket_builders.hpp"

namespace telehug {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr std::int64_t ms = 1'000'000;

// One touch of box 2, felt at actuators 2 and 3 (channels 1 and 2), and all is right.
DemoRecord right_record() {
  DemoRecord record;
  record.published = {{1, 10, 1000 * ms, 4, "down", 2, {100, 100}},
                      {2, 11, 1033 * ms, 4, "move", 2, {100, 100}},
                      {3, 12, 1066 * ms, 4, "up", 2, {100, 100}}};
  record.felt = {{4, "down", 2, "driven", {2, 3}}, {4, "up", 2, "driven", {2, 3}}};
  record.pins = {{1010 * ms, 1, true}, {1011 * ms, 2, true}, {1080 * ms, 1, false}, {1081 * ms, 2, false}};
  return record;
}

class DemoVerdict : public testing::Test {
 protected:
  [[nodiscard]] std::vector<std::string> found() const { return faults(record, profile); }

  DemoRecord record = right_record();
  JacketProfile profile = profile_of({motor(1, {}, {1}), motor(2, {}, {2}), motor(3, {}, {2, 3})});
};

TEST_F(DemoVerdict, FindsNothingWrongWithARightRecord) {
  EXPECT_THAT(found(), IsEmpty());
}

TEST_F(DemoVerdict, FindsThatNothingWasPublished) {
  record = {};
  EXPECT_THAT(found(), ElementsAre(HasSubstr("no touch was published")));
}

TEST_F(DemoVerdict, FindsThatEventsWereNotHeard) {
  record.add({{"event", "dropped"}, {"count", 2}});
  EXPECT_THAT(found(), ElementsAre(HasSubstr("2 events were not heard")));
}

TEST_F(DemoVerdict, FindsATouchThatWasNeverAnswered) {
  record.felt.clear();
  EXPECT_THAT(found(), ElementsAre(HasSubstr("contact 4 on box 2 was published and never answered")));
}

TEST_F(DemoVerdict, FindsATouchThatWasNotFelt) {
  record.felt[0].outcome = "stale";
  EXPECT_THAT(found(), ElementsAre(HasSubstr("was not felt: stale")));
}

TEST_F(DemoVerdict, FindsATouchThatWasFeltElsewhere) {
  record.felt[0].actuators = {1, 3};
  EXPECT_THAT(found(), ElementsAre("box 2 was felt at actuators 1,3 instead of 2,3"));
}

// Touches that are felt at their places: motor 1 lies in the middle of box 2, motor 2 beside it, motor 3 far away.
class DemoVerdictOfPlaces : public DemoVerdict {
 protected:
  DemoVerdictOfPlaces() {
    profile.rendering = Rendering::places;
    profile.actuators[0].place = {-0.5, 0.25};
    profile.actuators[1].place = {0, 0.25};
    profile.actuators[2].place = {1, 0.25};
    record.felt = {{4, "down", 2, "driven", {1}}, {4, "up", 2, "driven", {1}}};
    record.pins = {{1010 * ms, 0, true}, {1080 * ms, 0, false}};
  }
};

TEST_F(DemoVerdictOfPlaces, FindsNothingWrongWithSomeOfTheMotorsAboutAPlace) {
  EXPECT_THAT(found(), IsEmpty());
}

TEST_F(DemoVerdictOfPlaces, FindsATouchThatWasFeltFarAway) {
  record.felt[0].actuators = {1, 3};
  EXPECT_THAT(found(), ElementsAre("box 2 was felt at actuators 1,3 instead of 1,2"));
}

TEST_F(DemoVerdictOfPlaces, FindsThatNoPinMoved) {
  record.pins.clear();
  EXPECT_THAT(found(), testing::SizeIs(2));
}

TEST_F(DemoVerdictOfPlaces, FindsAPinFarAwayThatMoved) {
  record.pins.push_back({1090 * ms, 2, true});
  record.pins.push_back({1095 * ms, 2, false});
  EXPECT_THAT(found(), ElementsAre("the pin of channel 2 moved although no box of it was touched",
                                   "the pin of channel 2 moved although no box of it was touched"));
}

TEST_F(DemoVerdict, FindsAPinThatDidNotMove) {
  std::erase_if(record.pins, [](const PinChange& change) { return change.channel == 2; });
  EXPECT_THAT(found(), ElementsAre("contact 4 on box 2: the pin of motor 3 did not move"));
}

TEST_F(DemoVerdict, FindsAPinThatMovedTooLate) {
  for (PinChange& change : record.pins)
    change.time_ns += change.channel == 1 ? 550 * ms : 0;
  EXPECT_THAT(found(), ElementsAre("contact 4 on box 2: the pin of motor 2 did not move"));
}

TEST_F(DemoVerdict, FindsAPinOfAnotherBoxThatMoved) {
  record.pins.push_back({1050 * ms, 0, true});
  record.pins.push_back({1060 * ms, 0, false});
  const std::string fault = "the pin of channel 0 moved although no box of it was touched";
  EXPECT_THAT(found(), ElementsAre(fault, fault));
}

TEST_F(DemoVerdict, FindsAPinThatWentOnAfterTheTouch) {
  record.pins.back().time_ns = 1900 * ms;
  EXPECT_THAT(found(), ElementsAre("the pin of channel 2 moved although no box of it was touched"));
}

TEST_F(DemoVerdict, FindsAPinThatIsStillOnInTheEnd) {
  record.pins.pop_back();
  EXPECT_THAT(found(), ElementsAre("the pin of channel 2 was still on in the end"));
}

TEST_F(DemoVerdict, HearsOnlyWhatCountsOfTheDaemonsEvents) {
  DemoRecord heard;
  const nlohmann::json touch = {{"event", "touch"},    {"side", "active"}, {"event_sequence", 5}, {"frame", 9},
                                {"frame_time_ns", 77}, {"contact", 2},     {"phase", "down"},     {"box", 3},
                                {"x_mm", 1.5},         {"y_mm", 2.5}};
  nlohmann::json felt = {{"event", "felt"}, {"side", "passive"},   {"contact", 2},       {"phase", "down"},
                         {"box", 3},        {"outcome", "driven"}, {"actuators", {3, 1}}};
  heard.add(touch);
  heard.add(felt);
  felt["side"] = "active";  // the same answer, as it came to the other side
  heard.add(felt);
  heard.add({{"event", "running"}, {"side", "passive"}});
  ASSERT_EQ(heard.published.size(), 1U);
  EXPECT_EQ(heard.published[0].frame, 9U);
  EXPECT_DOUBLE_EQ(heard.published[0].screen.y_mm, 2.5);
  ASSERT_EQ(heard.felt.size(), 1U);
  EXPECT_THAT(heard.felt[0].actuators, ElementsAre(1, 3));
}

class ComparedWithTruth : public testing::Test {
 protected:
  static PublishedTouch touch(std::uint64_t frame, const char* phase, ScreenPoint at) {
    return {frame, frame, 0, 1, phase, 2, at};
  }
  // Touched in the frames 100 to 109, at (50, 60).
  static std::optional<ScreenPoint> truth(std::uint64_t frame) {
    if (frame < 100 || frame > 109) return std::nullopt;
    return ScreenPoint{50, 60};
  }
  [[nodiscard]] TruthComparison compare() const { return compare_with_truth(record, truth, 30); }

  DemoRecord record;
};

TEST_F(ComparedWithTruth, MeansAreTakenOverTheTouchesAndTheWorstOverBothAxes) {
  record.published = {touch(100, "down", {51, 58}), touch(101, "move", {47, 64}), touch(102, "up", {0, 0})};
  const TruthComparison found = compare();
  EXPECT_EQ(found.frames, 2);
  EXPECT_DOUBLE_EQ(found.mean_horizontal_mm, 2);
  EXPECT_DOUBLE_EQ(found.mean_vertical_mm, 3);
  EXPECT_DOUBLE_EQ(found.worst_mm, 4);
  EXPECT_EQ(found.without_touch, 0);
}

TEST_F(ComparedWithTruth, AContactThatIsHeldALittleAfterTheTouchIsNoFault) {
  record.published = {touch(114, "move", {50, 60})};  // 150 ms are 5 frames
  EXPECT_EQ(compare().without_touch, 0);
  EXPECT_EQ(compare().frames, 0);
}

TEST_F(ComparedWithTruth, AContactThatNobodyMadeIsCounted) {
  record.published = {touch(115, "move", {50, 60}), touch(94, "down", {50, 60}), touch(3, "down", {50, 60})};
  EXPECT_EQ(compare().without_touch, 3);
  EXPECT_EQ(compare().frames, 0);
}

TEST_F(ComparedWithTruth, NothingPublishedIsNothingCompared) {
  EXPECT_EQ(compare().frames, 0);
  EXPECT_DOUBLE_EQ(compare().mean_vertical_mm, 0);
}

}  // namespace
}  // namespace telehug
