// SPDX-License-Identifier: Apache-2.0
#include "finger/mirror_evidence.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <opencv2/core.hpp>

#include "doubles/allocation_counter.hpp"
#include "doubles/drawn_mirror.hpp"

namespace telehug {
namespace {

MirrorEvidence look(const DrawnMirror& scene) {
  return mirror_evidence(scene.picture(), scene.outline(), scene.normal());
}

TEST(MirrorEvidence, CallsAFingerTouchingWhoseMirrorImageBeginsAtItsTip) {
  const MirrorEvidence evidence = look({});
  EXPECT_EQ(evidence.state, MirrorState::touching);
  EXPECT_LT(evidence.gap_mm, 2);
  EXPECT_GT(evidence.confidence, 0.95);
}

TEST(MirrorEvidence, MeasuresHowFarAHoveringFingerIsFromTheScreen) {
  for (const double hover_mm : {7., 10., 15., 20.}) {
    DrawnMirror scene;
    scene.hover_mm = hover_mm;
    const MirrorEvidence evidence = look(scene);
    EXPECT_EQ(evidence.state, MirrorState::hovering) << hover_mm;
    EXPECT_NEAR(evidence.gap_mm, hover_mm, 1.5);
    EXPECT_NEAR(evidence.gap_px, scene.gap_px(), 14);
    EXPECT_GT(evidence.confidence, 0.98);
  }
}

TEST(MirrorEvidence, TellsTheSameDistanceAtEveryScale) {
  for (const double scale : {0.6, 0.8, 1.0, 1.25, 1.5}) {
    DrawnMirror scene;
    scene.scale = scale;
    EXPECT_EQ(look(scene).state, MirrorState::touching) << scale;
    scene.hover_mm = 10;
    const MirrorEvidence evidence = look(scene);
    EXPECT_EQ(evidence.state, MirrorState::hovering) << scale;
    EXPECT_NEAR(evidence.gap_mm, 10, 1.5) << scale;
  }
}

TEST(MirrorEvidence, SaysTheSameOfAPictureThatIsFlippedLeftToRight) {
  for (const double hover_mm : {0., 12.}) {
    DrawnMirror scene;
    scene.hover_mm = hover_mm;
    scene.roll = 0.03;
    scene.lean = 0.15;
    const cv::Mat picture = scene.picture();
    FingerOutline outline = scene.outline();
    const MirrorEvidence seen = mirror_evidence(picture, outline, scene.normal());
    cv::Mat flipped;
    cv::flip(picture, flipped, 1);
    outline.tip.u_px = picture.cols - 1 - outline.tip.u_px;
    outline.centre_u_px = picture.cols - 1 - outline.centre_u_px;
    outline.centre_slope *= -1;
    const MirrorEvidence mirrored = mirror_evidence(flipped, outline, {-scene.roll, scene.normal().px_per_mm});
    EXPECT_EQ(seen.state, hover_mm > 0 ? MirrorState::hovering : MirrorState::touching);
    EXPECT_EQ(mirrored.state, seen.state);
    EXPECT_NEAR(mirrored.gap_px, seen.gap_px, 8);
  }
}

TEST(MirrorEvidence, KnowsNothingOfAScreenThatDoesNotMirror) {
  for (const double hover_mm : {0., 10.}) {
    DrawnMirror scene;
    scene.share = 0;
    scene.hover_mm = hover_mm;
    const MirrorEvidence evidence = look(scene);
    EXPECT_EQ(evidence.state, MirrorState::unknown);
    EXPECT_EQ(evidence.gap_px, 0);
    EXPECT_EQ(evidence.confidence, 0);
  }
}

TEST(MirrorEvidence, KnowsNothingWhileTheMirrorImageLiesBelowThePicture) {
  DrawnMirror scene;
  scene.hover_mm = 15;
  scene.tip_v_px = 600;
  EXPECT_EQ(look(scene).state, MirrorState::unknown);
  scene.hover_mm = 0;
  EXPECT_EQ(look(scene).state, MirrorState::touching);
  scene.tip_v_px = 710;
  EXPECT_EQ(look(scene).state, MirrorState::unknown);
}

TEST(MirrorEvidence, SeesDarkFingersBeforeWhatTheScreenElseMirrors) {
  for (const double hover_mm : {0., 10.}) {
    DrawnMirror scene;
    scene.finger = {25, 30, 45};
    scene.screen = [](double, double) { return cv::Vec3d(150, 150, 150); };
    scene.share = 0.1;
    scene.hover_mm = hover_mm;
    EXPECT_EQ(look(scene).state, hover_mm > 0 ? MirrorState::hovering : MirrorState::touching);
  }
}

TEST(MirrorEvidence, FollowsTheRollOfTheCameraAndTheLeanOfTheFinger) {
  for (const double roll : {-0.06, 0.06}) {
    for (const double lean : {-0.2, 0.2}) {
      for (const double flatness : {1.0, 1.7, 2.4}) {
        DrawnMirror scene;
        scene.roll = roll;
        scene.lean = lean;
        scene.flatness = flatness;
        EXPECT_EQ(look(scene).state, MirrorState::touching) << roll << ' ' << lean << ' ' << flatness;
        scene.hover_mm = 12;
        EXPECT_EQ(look(scene).state, MirrorState::hovering) << roll << ' ' << lean << ' ' << flatness;
      }
    }
  }
}

TEST(MirrorEvidence, TakesNoEdgeOfTheScreensPictureForAMirrorImage) {
  for (double edge_u_px = 560; edge_u_px <= 720; edge_u_px += 10) {
    for (const double begins_v_px : {0., 380.}) {
      DrawnMirror scene;
      scene.share = 0;
      scene.screen = [=](double u, double v) { return cv::Vec3d::all(u > edge_u_px && v > begins_v_px ? 110 : 60); };
      EXPECT_EQ(look(scene).state, MirrorState::unknown) << edge_u_px << ' ' << begins_v_px;
    }
  }
}

TEST(MirrorEvidence, TakesNoSlopeOfBrightnessForAMirrorImage) {
  DrawnMirror scene;
  scene.share = 0;
  scene.screen = [](double u, double v) { return cv::Vec3d(u / 8, v / 5, (u + v) / 12); };
  EXPECT_EQ(look(scene).state, MirrorState::unknown);
}

TEST(MirrorEvidence, SeesAMirrorImageAmongLinesOfText) {
  for (const double hover_mm : {0., 10.}) {
    DrawnMirror scene;
    scene.screen = [](double u, double v) {
      const int line = static_cast<int>(v) / 12;
      return cv::Vec3d::all(line % 2 == 1 && static_cast<int>(u) / (17 + line % 5) % 4 != 0 ? 70 : 40);
    };
    scene.hover_mm = hover_mm;
    EXPECT_EQ(look(scene).state, hover_mm > 0 ? MirrorState::hovering : MirrorState::touching);
  }
}

TEST(MirrorEvidence, TakesTheWidthOfTheFingersEndFromItsContour) {
  DrawnMirror scene;
  FingerOutline outline = scene.outline();
  const ImagePoint tip = outline.tip;
  outline.half_width_px *= 0.5;
  EXPECT_NE(mirror_evidence(scene.picture(), outline, scene.normal()).state, MirrorState::touching);
  for (const double side : {-1., 1.})
    outline.contour.push_back({tip.u_px + side * DrawnMirror::half_width_px, tip.v_px - 15});
  EXPECT_EQ(mirror_evidence(scene.picture(), outline, scene.normal()).state, MirrorState::touching);
}

TEST(MirrorEvidence, KnowsNothingOfOutlinesThatMakeNoSense) {
  const DrawnMirror scene;
  const cv::Mat picture = scene.picture();
  for (const double nonsense : {0., -5., 1e9, std::numeric_limits<double>::quiet_NaN()}) {
    FingerOutline outline = scene.outline();
    outline.half_width_px = nonsense;
    EXPECT_EQ(mirror_evidence(picture, outline, scene.normal()).state, MirrorState::unknown) << nonsense;
    EXPECT_EQ(mirror_evidence(picture, scene.outline(), {0, nonsense > 0 ? -1 : nonsense}).state, MirrorState::unknown);
  }
  for (const double place : {-1e12, -50., 1e4, 1e12, std::numeric_limits<double>::quiet_NaN()}) {
    FingerOutline outline = scene.outline();
    outline.tip = {place, place};
    outline.centre_u_px = place;
    EXPECT_EQ(mirror_evidence(picture, outline, scene.normal()).state, MirrorState::unknown) << place;
  }
}

TEST(MirrorEvidence, AllocatesNothing) {
  const DrawnMirror scene;
  const cv::Mat picture = scene.picture();
  const FingerOutline outline = scene.outline();
  const auto before = allocation_count();
  const MirrorEvidence evidence = mirror_evidence(picture, outline, scene.normal());
  EXPECT_EQ(allocation_count(), before);
  EXPECT_EQ(evidence.state, MirrorState::touching);
}

}  // namespace
}  // namespace telehug
