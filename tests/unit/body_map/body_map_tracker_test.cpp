// SPDX-License-Identifier: Apache-2.0
#include "body_map/body_map_tracker.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace telehug {
namespace {

constexpr Duration look_interval = 125ms;
const ScreenRect view{.x_mm = 0, .y_mm = 0, .width_mm = 480, .height_mm = 300};

// A face 100 mm high with its middle at x and its chin at y.
ScreenRect face_at(double middle_mm, double chin_mm, double height_mm = 100) {
  return {.x_mm = middle_mm - height_mm * 0.36,
          .y_mm = chin_mm - height_mm,
          .width_mm = height_mm * 0.72,
          .height_mm = height_mm};
}

double middle_of(const BodyMap& map) {
  return map.face.x_mm + map.face.width_mm / 2;
}

class Looks {
 public:
  const BodyMap& at(const ScreenRect& face, std::uint32_t person = 1) {
    time += look_interval;
    seen_ = MappedFace{person, face, time};
    return tracker.update(time, seen_, view);
  }
  const BodyMap& held() {
    time += look_interval;
    return tracker.update(time, seen_, view);
  }
  const BodyMap& nobody() { return tracker.update(time += look_interval, std::nullopt, view); }
  const BodyMap& at_for(Duration duration, const ScreenRect& face) {
    for (const Timestamp end = time + duration; time < end;)
      at(face);
    return tracker.map();
  }

  BodyMapTracker tracker;
  Timestamp time = from_ns(5'000'000'000);

 private:
  std::optional<MappedFace> seen_;
};

TEST(BodyMapTracker, HasNoMapWithoutAFace) {
  Looks looks;
  EXPECT_EQ(looks.tracker.map().version, 0U);
  EXPECT_EQ(looks.nobody().version, 0U);
}

TEST(BodyMapTracker, LaysTheGridFromTheChinToTheBottomOfTheView) {
  Looks looks;
  const BodyMap& map = looks.at(face_at(240, 120));
  EXPECT_EQ(map.version, 1U);
  EXPECT_EQ(map.seen, looks.time);
  EXPECT_DOUBLE_EQ(map.grid.y_mm, 120);
  EXPECT_DOUBLE_EQ(map.grid.height_mm, 180);
  EXPECT_EQ(map.shape.rows, 4);
}

TEST(BodyMapTracker, StandsStillWithinTheDeadBand) {
  for (const ScreenRect& face : {face_at(249, 120), face_at(231, 120), face_at(240, 129), face_at(240, 111),
                                 face_at(240, 120, 109), face_at(240, 120, 91), face_at(249, 129, 109)}) {
    Looks looks;
    looks.at_for(2s, face_at(240, 120));
    const BodyMap& map = looks.at_for(20s, face);
    EXPECT_EQ(map.version, 1U);
    EXPECT_DOUBLE_EQ(middle_of(map), 240);
    EXPECT_EQ(map.seen, looks.time);
  }
}

TEST(BodyMapTracker, GlidesToAFaceThatLeftTheDeadBand) {
  for (const ScreenRect& face : {face_at(270, 120), face_at(210, 120), face_at(240, 150), face_at(240, 90),
                                 face_at(240, 120, 130), face_at(240, 120, 80)}) {
    Looks looks;
    looks.at_for(2s, face_at(240, 120));
    const BodyMap& map = looks.at_for(2s, face);
    EXPECT_GT(map.version, 2U) << "in more than one step";
    EXPECT_NEAR(middle_of(map), face.x_mm + face.width_mm / 2, 4);
    EXPECT_NEAR(map.grid.y_mm, face.y_mm + face.height_mm, 4);
    EXPECT_NEAR(map.box_side_mm, face.height_mm / 2, 2);
    const auto version = map.version;
    EXPECT_EQ(looks.at_for(5s, face).version, version) << "and stands there";
  }
}

// Sheet of facts: a move of 0.8 face heights in 0.7 s is settled after 0.75 s.
TEST(BodyMapTracker, HasSettledWithinASecondAfterSomebodyLeansOver) {
  Looks looks;
  looks.at_for(2s, face_at(200, 120));
  const Timestamp begun = looks.time;
  while (looks.time - begun < 700ms)
    looks.at(face_at(200 + 80 * std::chrono::duration<double>(looks.time + look_interval - begun).count() / 0.75, 120));
  EXPECT_NEAR(middle_of(looks.at_for(1s, face_at(280, 120))), 280, 10);
}

// The first find may be off; the dead band would keep the grid there.
TEST(BodyMapTracker, SettlesOnTheMeanOfTheFindsAfterALeap) {
  Looks looks;
  looks.at(face_at(248, 120));
  EXPECT_NEAR(middle_of(looks.at_for(1s, face_at(240, 120))), 240, 4);
  const auto version = looks.tracker.map().version;
  EXPECT_EQ(looks.at_for(5s, face_at(246, 120)).version, version);
}

TEST(BodyMapTracker, LeapsWhereThePictureHasMovedUnderTheFace) {
  Looks looks;
  looks.at_for(1s, face_at(200, 120));
  const BodyMap& map = looks.at(face_at(260, 120));
  EXPECT_EQ(map.version, 2U);
  EXPECT_DOUBLE_EQ(middle_of(map), 260);
}

TEST(BodyMapTracker, LeapsToAnotherPerson) {
  Looks looks;
  looks.at_for(1s, face_at(200, 120));
  const BodyMap& map = looks.at(face_at(205, 120), 2);
  EXPECT_EQ(map.version, 2U);
  EXPECT_DOUBLE_EQ(middle_of(map), 205);
}

// A person who sits and talks: sway and nodding of 2 % of the face height, noise of the finder (sheet of facts).
TEST(BodyMapTracker, StandsStillWhileSomebodySitsAndTalks) {
  std::mt19937 random{11};
  std::normal_distribution<double> noise(0, 1);
  Looks looks;
  looks.at_for(1s, face_at(240, 120));
  const auto version = looks.tracker.map().version;
  for (int i = 0; i < 8 * 60; ++i) {
    const double t = 2 * std::numbers::pi * i / 8;
    looks.at(face_at(240 + 2 * std::sin(t / 5) + 0.5 * noise(random), 120 + 2 * std::sin(t / 3) + 0.4 * noise(random),
                     100 + 3 * std::sin(t / 20) + 0.7 * noise(random)));
  }
  EXPECT_EQ(looks.tracker.map().version, version);
}

TEST(BodyMapTracker, StandsWhereItWasWhileAFaceIsHeld) {
  Looks looks;
  looks.at_for(1s, face_at(240, 120));
  const Timestamp seen = looks.time;
  const BodyMap& map = looks.held();
  EXPECT_EQ(map.version, 1U);
  EXPECT_EQ(map.seen, seen);
  EXPECT_DOUBLE_EQ(middle_of(map), 240);
}

// Casiez et al.: the filter needs the time since it was fed last, however long the face was held meanwhile.
TEST(BodyMapTracker, FiltersOverTheWholeTimeInWhichAFaceWasHeld) {
  Looks looks;
  looks.at_for(2s, face_at(240, 120));
  for (int i = 0; i < 8; ++i)
    looks.held();
  OneEuroFilter middle;
  middle.reset(240);
  middle.update(260, 9 * 0.125, 100);
  const double share = 1 - std::exp(-0.125 / 0.2);
  EXPECT_NEAR(middle_of(looks.at(face_at(260, 120))), std::lerp(240, middle.value(), share), 1e-6);
}

TEST(BodyMapTracker, MovesInHeightsOfTheFaceHoweverLargeThatIs) {
  std::mt19937 random{5};
  std::normal_distribution<double> step(0, 6);
  Looks small;
  Looks large;
  double off = 0;
  for (int i = 0; i < 200; ++i) {
    off += step(random);
    const double at = 40 * std::sin(off / 40);
    small.at(face_at(120 + at, 60 + at / 4, 50));
    large.at(face_at(240 + 2 * at, 120 + at / 2, 100));
    ASSERT_NEAR(2 * middle_of(small.tracker.map()), middle_of(large.tracker.map()), 1e-6) << "look " << i;
  }
}

TEST(BodyMapTracker, NeverUsesAVersionTwice) {
  Looks looks;
  looks.at(face_at(240, 120));
  EXPECT_EQ(looks.nobody().version, 0U);
  EXPECT_EQ(looks.nobody().shape, GridShape{});
  EXPECT_EQ(looks.at(face_at(240, 120)).version, 2U);
}

TEST(BodyMapTracker, UsesNoVersionThatAnotherOneMayHaveUsed) {
  BodyMapTrackerConfig config;
  config.versions_after = 5000;
  BodyMapTracker later(config);
  const Timestamp time = from_ns(1'000'000'000);
  EXPECT_EQ(later.update(time, MappedFace{1, face_at(240, 120), time}, view).version, 5001U);
}

TEST(BodyMapTracker, EndsTheGridWhereAnotherViewEnds) {
  Looks looks;
  looks.at(face_at(240, 120));
  ScreenRect lower = view;
  lower.height_mm = 250;
  const BodyMap& map =
      looks.tracker.update(looks.time + 125ms, MappedFace{1, face_at(240, 120), looks.time + 125ms}, lower);
  EXPECT_EQ(map.version, 2U);
  EXPECT_DOUBLE_EQ(map.grid.height_mm, 130);
}

TEST(BodyMapTracker, HasNoMapOfAFaceWithoutABodyBelow) {
  EXPECT_EQ(Looks().at(face_at(240, 300)).version, 0U);
  EXPECT_EQ(Looks().at(face_at(240, 290)).version, 1U);
}

TEST(BodyMapTracker, BearsAFaceWithoutHeight) {
  Looks looks;
  looks.at(face_at(240, 120));
  EXPECT_EQ(looks.at({.x_mm = 200, .y_mm = 100, .width_mm = 0, .height_mm = 0}).version, 0U);
  EXPECT_EQ(looks.at(face_at(240, 120)).version, 2U);
}

}  // namespace
}  // namespace telehug
