// SPDX-License-Identifier: Apache-2.0
#include "body_map/body_map_tracker.hpp"

#include <gtest/gtest.h>

namespace telehug {
namespace {

const ScreenRect view{.x_mm = 0, .y_mm = 0, .width_mm = 480, .height_mm = 300};

// A face 100 mm high with its middle at x and its chin at y.
ScreenRect face_at(double middle_mm, double chin_mm, double height_mm = 100) {
  return {.x_mm = middle_mm - 36, .y_mm = chin_mm - height_mm, .width_mm = 72, .height_mm = height_mm};
}

Timestamp at(Duration since_start) {
  return from_ns(5'000'000'000) + since_start;
}

TEST(BodyMapTracker, HasNoMapBeforeTheFirstFace) {
  BodyMapTracker tracker;
  EXPECT_EQ(tracker.map().version, 0U);
  EXPECT_EQ(tracker.searched(at(0ms), std::nullopt, view).version, 0U);
  EXPECT_EQ(tracker.unchanged(at(125ms)).version, 0U);
  EXPECT_EQ(tracker.lost(at(250ms)).version, 0U);
}

TEST(BodyMapTracker, LaysTheGridFromTheChinToTheBottomOfTheView) {
  BodyMapTracker tracker;
  const BodyMap& map = tracker.searched(at(0ms), face_at(240, 120), view);
  EXPECT_EQ(map.version, 1U);
  EXPECT_EQ(map.seen, at(0ms));
  EXPECT_DOUBLE_EQ(map.grid.y_mm, 120);
  EXPECT_DOUBLE_EQ(map.grid.height_mm, 180);
  EXPECT_EQ(map.shape.rows, 4);
}

TEST(BodyMapTracker, StandsStillWithinTheDeadBand) {
  BodyMapTracker tracker;
  tracker.searched(at(0ms), face_at(240, 120), view);
  for (const ScreenRect& face : {face_at(249, 120), face_at(231, 120), face_at(240, 129), face_at(240, 111),
                                 face_at(240, 120, 109), face_at(240, 120, 91), face_at(249, 129, 109)}) {
    const BodyMap& map = tracker.searched(at(125ms), face, view);
    EXPECT_EQ(map.version, 1U);
    EXPECT_DOUBLE_EQ(map.face.x_mm, face_at(240, 120).x_mm);
    EXPECT_EQ(map.seen, at(125ms));
  }
}

TEST(BodyMapTracker, FollowsTheFaceOutOfTheDeadBandAsANewVersion) {
  for (const ScreenRect& face : {face_at(251, 120), face_at(229, 120), face_at(240, 131), face_at(240, 109),
                                 face_at(240, 120, 111), face_at(240, 120, 89)}) {
    BodyMapTracker tracker;
    tracker.searched(at(0ms), face_at(240, 120), view);
    const BodyMap& map = tracker.searched(at(125ms), face, view);
    EXPECT_EQ(map.version, 2U);
    EXPECT_DOUBLE_EQ(map.face.x_mm, face.x_mm);
    EXPECT_DOUBLE_EQ(map.grid.y_mm, face.y_mm + face.height_mm);
    EXPECT_DOUBLE_EQ(map.box_side_mm, face.height_mm / 2);
  }
}

TEST(BodyMapTracker, FollowsASlowDriftInSteps) {
  BodyMapTracker tracker;
  Duration time = 0ms;
  for (int mm = 0; mm <= 44; ++mm, time += 125ms) {
    tracker.searched(at(time), face_at(200 + mm, 120), view);
  }
  EXPECT_EQ(tracker.map().version, 5U);
  EXPECT_DOUBLE_EQ(tracker.map().face.x_mm, face_at(244, 120).x_mm);
}

TEST(BodyMapTracker, HoldsTheGridForTheHoldTimeThenDropsIt) {
  BodyMapTracker tracker;
  tracker.searched(at(0ms), face_at(240, 120), view);
  EXPECT_EQ(tracker.searched(at(1000ms), std::nullopt, view).version, 1U);
  EXPECT_EQ(tracker.map().seen, at(0ms));
  EXPECT_EQ(tracker.searched(at(1500ms), std::nullopt, view).version, 1U);
  EXPECT_EQ(tracker.searched(at(1501ms), std::nullopt, view).version, 0U);
  EXPECT_EQ(tracker.map().shape, GridShape{});
}

TEST(BodyMapTracker, KeepsTheVersionOfAFaceThatComesBackInTime) {
  BodyMapTracker tracker;
  tracker.searched(at(0ms), face_at(240, 120), view);
  tracker.searched(at(1400ms), std::nullopt, view);
  EXPECT_EQ(tracker.searched(at(1600ms), face_at(241, 120), view).version, 1U);
  EXPECT_EQ(tracker.searched(at(3000ms), std::nullopt, view).version, 1U) << "the hold time runs anew";
}

TEST(BodyMapTracker, NeverUsesAVersionTwice) {
  BodyMapTracker tracker;
  tracker.searched(at(0ms), face_at(240, 120), view);
  tracker.searched(at(2000ms), std::nullopt, view);
  EXPECT_EQ(tracker.searched(at(2100ms), face_at(240, 120), view).version, 2U);
}

TEST(BodyMapTracker, SeesTheFaceInAPictureThatStandsStill) {
  BodyMapTracker tracker;
  tracker.searched(at(0ms), face_at(240, 120), view);
  EXPECT_EQ(tracker.unchanged(at(60s)).version, 1U);
  EXPECT_EQ(tracker.map().seen, at(60s));
}

TEST(BodyMapTracker, LetsTheHoldTimeRunWhileAPictureWithoutFaceStandsStill) {
  BodyMapTracker tracker;
  tracker.searched(at(0ms), face_at(240, 120), view);
  tracker.searched(at(125ms), std::nullopt, view);
  EXPECT_EQ(tracker.unchanged(at(1500ms)).version, 1U);
  EXPECT_EQ(tracker.map().seen, at(0ms));
  EXPECT_EQ(tracker.unchanged(at(1600ms)).version, 0U);
}

TEST(BodyMapTracker, HoldsAndDropsTheGridWhenTheScreenIsLost) {
  BodyMapTracker tracker;
  tracker.searched(at(0ms), face_at(240, 120), view);
  EXPECT_EQ(tracker.lost(at(1000ms)).version, 1U);
  EXPECT_EQ(tracker.lost(at(1600ms)).version, 0U);
  EXPECT_EQ(tracker.unchanged(at(1700ms)).version, 0U) << "the face of before is not taken for seen";
}

TEST(BodyMapTracker, IsNotCarriedAwayByOneFalseFind) {
  BodyMapTracker tracker;
  tracker.searched(at(0ms), face_at(240, 120), view);
  for (const ScreenRect& false_find : {face_at(341, 120), face_at(240, 221), face_at(240, 120, 131)}) {
    EXPECT_EQ(tracker.searched(at(125ms), false_find, view).version, 1U);
    EXPECT_EQ(tracker.map().seen, at(0ms));
  }
  EXPECT_EQ(tracker.searched(at(250ms), face_at(241, 120), view).version, 1U);
}

TEST(BodyMapTracker, TakesAnotherFaceWhenTheFollowedOneHasBeenGoneForTheHoldTime) {
  BodyMapTracker tracker;
  tracker.searched(at(0ms), face_at(100, 120), view);
  EXPECT_EQ(tracker.searched(at(1500ms), face_at(400, 120), view).version, 1U);
  const BodyMap& map = tracker.searched(at(1625ms), face_at(400, 120), view);
  EXPECT_EQ(map.version, 2U);
  EXPECT_EQ(map.seen, at(1625ms));
  EXPECT_DOUBLE_EQ(map.face.x_mm, face_at(400, 120).x_mm);
}

TEST(BodyMapTracker, TakesAnotherFaceAlsoFromAPictureThatStandsStill) {
  BodyMapTracker tracker;
  tracker.searched(at(0ms), face_at(100, 120), view);
  tracker.searched(at(125ms), face_at(400, 120), view);
  EXPECT_EQ(tracker.unchanged(at(1500ms)).version, 1U);
  EXPECT_EQ(tracker.unchanged(at(1625ms)).version, 2U);
}

TEST(BodyMapTracker, HoldsNothingOverFromAnotherView) {
  ScreenRect moved = view;
  moved.height_mm = 250;
  BodyMapTracker tracker;
  tracker.searched(at(0ms), face_at(240, 120), view);
  EXPECT_EQ(tracker.searched(at(125ms), std::nullopt, moved).version, 0U);
  tracker.searched(at(250ms), face_at(240, 120), moved);
  EXPECT_EQ(tracker.map().version, 2U);
  EXPECT_DOUBLE_EQ(tracker.map().grid.height_mm, 130);
  EXPECT_EQ(tracker.searched(at(375ms), face_at(400, 120), view).version, 3U) << "at once, however far it is";
}

TEST(BodyMapTracker, HasNoMapOfAFaceWithoutABodyBelow) {
  BodyMapTracker tracker;
  EXPECT_EQ(tracker.searched(at(0ms), face_at(240, 300), view).version, 0U);
  EXPECT_EQ(tracker.searched(at(125ms), face_at(240, 290), view).version, 1U);
}

}  // namespace
}  // namespace telehug
