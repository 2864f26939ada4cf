// SPDX-License-Identifier: Apache-2.0
#include "body_map/body_map_step.hpp"

#include <gmock/gmock.h>

#include "body_map/vitruvian_grid.hpp"
#include "doubles/fake_clock.hpp"
#include "doubles/planned_face_finder.hpp"
#include "doubles/planned_screen_grabber.hpp"
#include "face/haar_face_finder.hpp"
#include "screen/picture_grabber.hpp"

namespace telehug {
namespace {

using testing::HasSubstr;

// 0.5 mm a pixel sideways, 0.25 mm a pixel down.
const BodyMapStepConfig config{
    .screen = ScreenSize{.width_mm = 400, .height_mm = 200, .width_px = 800, .height_px = 800},
    .rules = {},
    .tracker = {},
    .mirrored = false};

class BodyMapStepTest : public testing::Test {
 protected:
  BodyMapStepTest() {
    grabber.picture = {.bgr = cv::Mat(600, 700, CV_8UC3, cv::Scalar(0, 0, 0)),
                       .origin_px = {100, 40},
                       .monitor = {.width_px = 800, .height_px = 800},
                       .time = from_ns(1'000'000'000),
                       .in_front = {}};
  }
  void look(GrabOutcome outcome, Duration later = 125ms) {
    grabber.outcome = outcome;
    grabber.picture.time += later;
    step.run();
    map = step.map();
  }

  PlannedScreenGrabber grabber;
  PlannedFaceFinder finder{{{.box = {300, 100, 80, 160}, .score = 1}}};
  BodyMapStep step{grabber, finder, config};
  BodyMap map;
};

TEST_F(BodyMapStepTest, LaysTheGridInMillimetresOfTheScreen) {
  look(GrabOutcome::changed);
  EXPECT_EQ(map.version, 1U);
  EXPECT_EQ(map.seen, grabber.picture.time);
  EXPECT_DOUBLE_EQ(map.face.x_mm, (100 + 300) * 0.5);
  EXPECT_DOUBLE_EQ(map.face.y_mm, (40 + 100) * 0.25);
  EXPECT_DOUBLE_EQ(map.face.width_mm, 40);
  EXPECT_DOUBLE_EQ(map.face.height_mm, 40);
  EXPECT_DOUBLE_EQ(map.box_side_mm, 20);
  EXPECT_DOUBLE_EQ(map.grid.y_mm, (40 + 260) * 0.25);
  EXPECT_DOUBLE_EQ(map.grid.y_mm + map.grid.height_mm, (40 + 600) * 0.25) << "the bottom of the looked-at part";
  EXPECT_EQ(step.problem(), "");
}

TEST_F(BodyMapStepTest, SearchesAScreenThatStandsStillOnlyOnce) {
  look(GrabOutcome::changed);
  look(GrabOutcome::unchanged, 10s);
  look(GrabOutcome::unchanged, 10s);
  EXPECT_EQ(finder.searches, 1);
  EXPECT_EQ(map.version, 1U);
  EXPECT_EQ(map.seen, grabber.picture.time);
}

TEST_F(BodyMapStepTest, SaysThatNoFaceIsSeen) {
  finder.faces = FoundFaces{};
  look(GrabOutcome::changed);
  EXPECT_EQ(map.version, 0U);
  EXPECT_THAT(step.problem(), HasSubstr("No face"));
}

TEST_F(BodyMapStepTest, SaysThatThereIsNoBodyBelowTheFace) {
  finder.faces = FoundFaces{{.box = {300, 440, 80, 160}, .score = 1}};
  look(GrabOutcome::changed);
  EXPECT_EQ(map.version, 0U);
  EXPECT_THAT(step.problem(), HasSubstr("nothing of the body"));
}

TEST_F(BodyMapStepTest, LeavesOutTheOwnPictureInTheCornerOfTheLookedAtPart) {
  finder.faces = FoundFaces{{.box = {600, 430, 80, 120}, .score = 1}};
  look(GrabOutcome::changed);
  EXPECT_EQ(map.version, 0U);
}

TEST_F(BodyMapStepTest, HasNoMapWhileTheScreenIsNotSeen) {
  look(GrabOutcome::changed);
  look(GrabOutcome::lost);
  EXPECT_EQ(map.version, 0U) << "at once: a lost face is held, a lost screen is not";
  EXPECT_EQ(step.problem(), "The screen is gone.");
  EXPECT_FALSE(step.in_front());
  look(GrabOutcome::changed);
  EXPECT_EQ(map.version, 2U);
  EXPECT_EQ(step.problem(), "");
}

TEST_F(BodyMapStepTest, LivesOnWhenTheFinderFails) {
  look(GrabOutcome::changed);
  const Result<FoundFaces> faces = finder.faces;
  finder.faces = Error{"The finder has failed."};
  look(GrabOutcome::changed, 2s);
  EXPECT_EQ(map.version, 0U);
  EXPECT_EQ(step.problem(), "The finder has failed.");
  finder.faces = faces;
  look(GrabOutcome::changed);
  EXPECT_EQ(map.version, 2U);
}

TEST_F(BodyMapStepTest, LeapsWithAWindowThatIsMoved) {
  look(GrabOutcome::changed);
  EXPECT_TRUE(step.follower().pin());
  grabber.picture.origin_px.x = 60;
  look(GrabOutcome::changed);
  EXPECT_EQ(map.version, 2U);
  EXPECT_DOUBLE_EQ(map.face.x_mm, (60 + 300) * 0.5) << "a small move, but none of the face's";
  EXPECT_TRUE(step.follower().pinned()) << "everybody is where they were in the window";
}

TEST_F(BodyMapStepTest, HoldsNothingOverFromAnotherSizeOfTheWindowOrTheMonitor) {
  const FoundFaces faces = *finder.faces;
  look(GrabOutcome::changed);
  finder.faces = FoundFaces{};
  grabber.picture.bgr = cv::Mat(600, 690, CV_8UC3, cv::Scalar(0, 0, 0));
  look(GrabOutcome::changed);
  EXPECT_EQ(map.version, 0U);
  finder.faces = faces;
  look(GrabOutcome::changed);
  EXPECT_EQ(map.version, 2U);
  grabber.picture.monitor.width_px = 1600;
  look(GrabOutcome::changed);
  EXPECT_DOUBLE_EQ(map.face.x_mm, (100 + 300) * 0.25) << "twice as many pixels on the same screen";
}

TEST_F(BodyMapStepTest, SearchesAPictureAgainThatCouldNotBeSearched) {
  const FoundFaces faces = *finder.faces;
  finder.faces = Error{"The finder has failed."};
  look(GrabOutcome::changed);
  EXPECT_EQ(map.version, 0U);
  finder.faces = faces;
  look(GrabOutcome::unchanged);
  EXPECT_EQ(map.version, 1U);
}

TEST_F(BodyMapStepTest, HasNobodyToChooseWhileTheScreenIsNotSeen) {
  finder.faces = FoundFaces{{.box = {300, 100, 80, 160}, .score = 1}, {.box = {450, 100, 75, 150}, .score = 1}};
  look(GrabOutcome::changed);
  EXPECT_EQ(step.follower().others(), 1);
  look(GrabOutcome::lost);
  EXPECT_EQ(step.follower().others(), 0);
  EXPECT_FALSE(step.follower().next());
}

TEST_F(BodyMapStepTest, KnowsNobodyAnyMoreAfterARest) {
  finder.faces = FoundFaces{{.box = {300, 100, 80, 160}, .score = 1}, {.box = {450, 100, 75, 150}, .score = 1}};
  look(GrabOutcome::changed);
  EXPECT_EQ(step.follower().others(), 1);
  step.rest();
  EXPECT_EQ(step.follower().others(), 0);
  EXPECT_EQ(step.map().version, 0U);
  EXPECT_FALSE(step.in_front());
}

TEST_F(BodyMapStepTest, TellsWhetherThePinnedWindowIsInFront) {
  EXPECT_FALSE(step.in_front()) << "not looked yet";
  for (const bool in_front : {true, false}) {
    grabber.picture.in_front = in_front;
    look(GrabOutcome::changed);
    EXPECT_EQ(step.in_front(), in_front);
    look(GrabOutcome::unchanged);
    EXPECT_EQ(step.in_front(), in_front);
  }
}

TEST_F(BodyMapStepTest, SaysThatAFaceOnALiveScreenNeverMoves) {
  grabber.live = true;
  BodyMapStep live(grabber, finder, config);
  for (int i = 0; i < 20; ++i) {
    grabber.picture.time += 125ms;
    EXPECT_EQ(live.run().version, 0U);
  }
  EXPECT_THAT(live.problem(), HasSubstr("never moves"));
}

TEST_F(BodyMapStepTest, CountsTheBoxesOfAMirroredPictureFromTheRight) {
  BodyMapStepConfig mirrored = config;
  mirrored.mirrored = true;
  EXPECT_TRUE(BodyMapStep(grabber, finder, mirrored).run().mirrored);
}

TEST_F(BodyMapStepTest, RefusesAScreenWithoutSize) {
  BodyMapStepConfig none = config;
  none.screen = ScreenSize{};
  BodyMapStep unmeasured(grabber, finder, none);
  EXPECT_EQ(unmeasured.run().version, 0U);
  EXPECT_THAT(unmeasured.problem(), HasSubstr("mm"));
}

TEST_F(BodyMapStepTest, TakesAPixelForAMillimetreWhereTheScreenIsNotKnown) {
  BodyMapStepConfig unknown = config;
  unknown.screen.reset();
  BodyMapStep step_in_px(grabber, finder, unknown);
  EXPECT_DOUBLE_EQ(step_in_px.run().face.x_mm, 100 + 300);
  EXPECT_DOUBLE_EQ(step_in_px.map().box_side_mm, 80);
}

TEST(FaceOnAChatPicture, GivesTheBoxUnderATouchOnTheChest) {
  auto finder = make_haar_face_finder();
  ASSERT_TRUE(finder) << finder.error().message;
  const FakeClock clock;
  PictureGrabber grabber(
      {.path = std::filesystem::path(TELEHUG_FIXTURES) / "chat" / "02_self.jpg", .view = cv::Rect(153, 102, 793, 675)},
      clock);
  ASSERT_TRUE(grabber.open());
  // 0.25 mm a pixel: the labelled face is 57 mm high, its chin at (137, 105) mm, a box 29 mm wide.
  BodyMapStep step(grabber, **finder,
                   {.screen = ScreenSize{.width_mm = 320, .height_mm = 256, .width_px = 1280, .height_px = 1024},
                    .rules = {},
                    .tracker = {},
                    .mirrored = false});
  const BodyMap map = step.run();
  ASSERT_EQ(map.version, 1U) << step.problem();
  EXPECT_NEAR(map.face.height_mm, 57, 9);
  EXPECT_NEAR(map.grid.y_mm + map.grid.height_mm, (102 + 675) * 0.25, 1e-9);
  const auto hit = box_at(map, {.x_mm = 137, .y_mm = 105 + 1.5 * 28});
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->box, 8) << "second row, middle";
  EXPECT_NEAR(hit->body.x_fh, 0, 0.12);
  EXPECT_FALSE(box_at(map, {.x_mm = 10, .y_mm = 200}));
}

}  // namespace
}  // namespace telehug
