// SPDX-License-Identifier: Apache-2.0
#include "calibration/consistent_touches.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "doubles/random_rig.hpp"

namespace telehug {
namespace {

using testing::ElementsAre;

TEST(ConsistentTouches, AreAllThatOneCameraSaw) {
  RandomRigs random(71);
  for (int i = 0; i < 20; ++i) {
    const RigObservations seen = random.observe(random.rig(), 9, 0.3, 0.3);
    EXPECT_EQ(consistent_touches(seen).size(), seen.touches.size()) << i;
  }
}

TEST(ConsistentTouches, AreWithoutThoseThatLieElsewhere) {
  RandomRigs random(72);
  for (int i = 0; i < 10; ++i) {
    RigObservations seen = random.observe(random.usual_rig(), 9, 0.3, 0.3);
    seen.touches[1].image.u_px += random.between(40, 200);
    seen.touches[4].image.v_px -= random.between(40, 100);
    seen.touches[7].image.u_px -= random.between(40, 200);
    EXPECT_THAT(consistent_touches(seen), ElementsAre(0, 2, 3, 5, 6, 8)) << i;
  }
}

TEST(ConsistentTouches, LookAtThoseAgainThatWereLeftOut) {
  RandomRigs random(73);
  RigObservations seen = random.observe(random.usual_rig(), 6, 0.3, 0.3);
  seen.touches[2].left_out = true;
  EXPECT_THAT(consistent_touches(seen), ElementsAre(0, 1, 2, 3, 4, 5));
}

TEST(ConsistentTouches, AreAllIfThereAreFewerThanFour) {
  RandomRigs random(74);
  RigObservations seen = random.observe(random.usual_rig(), 3, 0.3, 0.3);
  seen.touches[1].image.u_px += 300;
  EXPECT_THAT(consistent_touches(seen), ElementsAre(0, 1, 2));
}

TEST(ConsistentTouches, AreThoseThatAgreeWithFiveMarks) {
  RandomRigs random(75);
  const KnownRig rig = random.usual_rig();
  RigObservations seen = random.observe(rig, 7, 0, 0.3);
  for (PointObservation& touch : seen.touches) {
    touch.image = rig.model.camera.project(touch.screen).value();
    touch.evidence = TouchEvidence::dot;
  }
  seen.marks.assign(seen.touches.begin() + 2, seen.touches.end());
  seen.touches.resize(2);
  EXPECT_THAT(consistent_touches(seen), ElementsAre(0, 1));
  seen.touches[0].image.u_px += 30;
  EXPECT_THAT(consistent_touches(seen), ElementsAre(1));
  // A contact is seen less exactly than a dot, but a nail's tip is not where the finger touches.
  seen.touches[0].evidence = TouchEvidence::contact;
  seen.touches[0].sigma_v_px = 1.5;
  seen.touches[0].image = rig.model.camera.project(seen.touches[0].screen).value();
  seen.touches[0].image.v_px += 7;
  EXPECT_THAT(consistent_touches(seen), ElementsAre(0, 1));
  seen.touches[0].image.v_px += 3;
  EXPECT_THAT(consistent_touches(seen), ElementsAre(1));
  seen.marks.pop_back();
  EXPECT_THAT(consistent_touches(seen), ElementsAre(0, 1));
}

TEST(ConsistentTouches, FarBesideFewMarksAreThoseThatAgreeWithThemAndTheOthers) {
  RandomRigs random(77);
  for (int i = 0; i < 10; ++i) {
    const KnownRig rig = random.usual_rig();
    RigObservations seen = random.observe(rig, 9, 0.3, 0.3);
    // Five marks about a place, not exactly seen.
    const ScreenPoint middle{0.5 * rig.screen.width_mm, 0.85 * rig.screen.height_mm};
    for (int mark = 0; mark < 5; ++mark) {
      const ScreenPoint at{middle.x_mm + 30 * (mark % 3 - 1), middle.y_mm + 20 * (mark % 2)};
      ImagePoint image = rig.model.camera.project(at).value();
      image.u_px += random.normal(0.25);
      image.v_px += random.normal(0.25);
      seen.marks.push_back({at, image, 1, 1, TouchEvidence::dot});
    }
    for (PointObservation& touch : seen.touches) {
      touch.image = rig.model.camera.project(touch.screen).value();
      touch.evidence = TouchEvidence::dot;
    }
    EXPECT_EQ(consistent_touches(seen).size(), seen.touches.size()) << i;
    seen.touches[3].image.u_px += 60;
    EXPECT_THAT(consistent_touches(seen), ElementsAre(0, 1, 2, 4, 5, 6, 7, 8)) << i;
  }
}

}  // namespace
}  // namespace telehug
