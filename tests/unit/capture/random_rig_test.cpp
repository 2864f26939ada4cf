// SPDX-License-Identifier: Apache-2.0
#include "capture/virtual_rig/random_rig.hpp"

#include <gtest/gtest.h>

#include <array>
#include <opencv2/core.hpp>
#include <set>

#include "capture/virtual_rig/random_frame.hpp"
#include "capture/virtual_rig/rig_renderer.hpp"
#include "capture/virtual_rig/virtual_rig.hpp"

namespace telehug {
namespace {

constexpr std::array kinds{FrameKind::touch,  FrameKind::hover,       FrameKind::away,
                           FrameKind::nohand, FrameKind::two_fingers, FrameKind::two_hands};

// A rig with a small picture and a coarse screen, so that hundreds are drawn in seconds.
RandomRig small_rig(std::uint64_t seed) {
  RandomRig rig = random_rig(seed, {192, 108});
  rig.settings.screen.width_px /= 8;
  rig.settings.screen.height_px /= 8;
  return rig;
}

PinholeCamera camera_of(const VirtualRigSettings& s) {
  return {s.camera, s.focal_px, s.image, s.distortion_k1};
}

TEST(RandomRig, IsDrawnWithoutFaultTwoHundredTimes) {
  std::set<std::string> groups;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const RandomRig rig = small_rig(seed);
    const Status checked = check_virtual_rig(rig.settings);
    ASSERT_TRUE(checked) << seed << ": " << checked.error().message;
    for (const std::string& group : {rig.group.bezel, rig.group.light, rig.group.coat, rig.group.desk})
      groups.insert(group);
    const RandomFrame frame = random_frame(rig, kinds[seed % kinds.size()], seed);
    VirtualRigSettings showing = rig.settings;
    showing.content = frame.content;
    RigRenderer renderer(showing);
    cv::Mat bgr;
    renderer.draw(frame.hands, seed, bgr);
    ASSERT_EQ(bgr.size(), cv::Size(192, 108));
    cv::Scalar mean;
    cv::Scalar deviation;
    cv::meanStdDev(bgr, mean, deviation);
    EXPECT_GT(deviation[1], 5) << seed;  // neither black nor burnt out
    EXPECT_GT(mean[1], 15) << seed;
    EXPECT_LT(mean[1], 235) << seed;
  }
  EXPECT_EQ(groups.size(), 4u + 5u + 3u + 3u);  // every kind of bezel, light, coat and desk came
}

TEST(RandomRig, IsTheSameForTheSameSeedOnly) {
  cv::Mat pictures[3];
  for (int i = 0; i < 3; ++i) {
    const RandomRig rig = small_rig(i == 2 ? 8 : 7);
    RigRenderer renderer(rig.settings);
    renderer.draw(random_frame(rig, FrameKind::touch, 3).hands, 3, pictures[i]);
  }
  EXPECT_EQ(cv::norm(pictures[0], pictures[1], cv::NORM_INF), 0);
  EXPECT_GT(cv::norm(pictures[0], pictures[2], cv::NORM_INF), 20);
}

TEST(RandomRig, StaysWithinItsRanges) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const VirtualRigSettings s = random_rig(seed).settings;
    EXPECT_TRUE(s.screen.width_mm >= 300 && s.screen.width_mm <= 700) << seed;
    EXPECT_TRUE(s.focal_px >= 800 && s.focal_px <= 1150) << seed;
    EXPECT_LE(std::abs(s.distortion_k1), 0.08) << seed;
    EXPECT_LE(std::abs(s.camera.position_mm[0] - s.screen.width_mm / 2), 30) << seed;
    EXPECT_TRUE(s.camera.position_mm[2] >= 25 && s.camera.position_mm[2] <= 80) << seed;
    for (const double angle : {s.camera.pitch_deg, s.camera.yaw_deg, s.camera.roll_deg})
      EXPECT_LE(std::abs(angle), 4) << seed;
    EXPECT_GE(calibration_points(s).size(), 5u) << seed;
  }
}

TEST(RandomFrame, TouchesWhatTheCameraSees) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const RandomRig rig = random_rig(seed);
    const PinholeCamera camera = camera_of(rig.settings);
    for (const FrameKind kind : {FrameKind::touch, FrameKind::two_fingers, FrameKind::two_hands}) {
      const std::vector<TruthRow> rows = truth_of(random_frame(rig, kind, seed), "1");
      EXPECT_EQ(rows.size(), kind == FrameKind::touch ? 1u : 2u) << seed;
      for (const TruthRow& row : rows) {
        EXPECT_TRUE(row.contact);
        const ImagePoint p = camera.project({row.screen->x_mm, row.screen->y_mm, 0});
        EXPECT_TRUE(p.u_px > 0 && p.u_px < 1279 && p.v_px > 0 && p.v_px < 719) << seed;
      }
    }
    const std::vector<TruthRow> hover = truth_of(random_frame(rig, FrameKind::hover, seed), "1");
    EXPECT_TRUE(*hover[0].hover_mm >= 5 && *hover[0].hover_mm <= 60);
    EXPECT_FALSE(truth_of(random_frame(rig, FrameKind::nohand, seed), "1")[0].screen.has_value());
  }
}

TEST(RandomFrame, KeepsADistantHandAboveTheBorderInThePicture) {
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    RandomRig rig = small_rig(seed);
    rig.settings.noise_sd = 0;
    rig.settings.sensor.auto_exposure = 0;
    rig.settings.sensor.exposure_spread = 0;
    rig.settings.coat.mirror = 0;
    RigRenderer renderer(rig.settings);
    cv::Mat without;
    cv::Mat with;
    renderer.draw(std::vector<HandPose>{}, 0, without);
    const RandomFrame frame = random_frame(rig, FrameKind::away, seed);
    renderer.draw(frame.hands, 0, with);
    const PinholeCamera camera = camera_of(rig.settings);
    EXPECT_GT(cv::norm(with, without, cv::NORM_INF), 20) << seed;  // it is in view
    for (int u = 0; u < with.cols; ++u) {
      // The screen's part of the column, from the border on, is as it was.
      for (double x_mm = 0; x_mm < rig.settings.screen.width_mm; x_mm += 5) {
        const ImagePoint border = camera.project({x_mm, rig.settings.screen.height_mm - 2, 0});
        if (std::abs(border.u_px - u) > 1 || border.v_px >= with.rows - 2) continue;
        const auto v = static_cast<int>(border.v_px) + 2;
        EXPECT_LT(cv::norm(with.at<cv::Vec3b>(v, u), without.at<cv::Vec3b>(v, u), cv::NORM_INF), 16)
            << seed << " at " << u << ", " << v;
      }
    }
  }
}

TEST(RandomFrame, LaysPalmsAcrossTheBorderWithoutATouch) {
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    RandomRig rig = small_rig(seed);
    rig.settings.noise_sd = 0;
    rig.settings.sensor.auto_exposure = 0;
    rig.settings.sensor.exposure_spread = 0;
    rig.settings.coat.mirror = 0;
    const RandomFrame frame = random_frame(rig, FrameKind::palm, seed);
    const std::vector<TruthRow> rows = truth_of(frame, "1");
    ASSERT_EQ(rows.size(), 1u);
    EXPECT_FALSE(rows[0].contact);
    EXPECT_FALSE(rows[0].screen.has_value());
    EXPECT_EQ(rows[0].notes.rfind("palm", 0), 0u) << rows[0].notes;
    RigRenderer renderer(rig.settings);
    cv::Mat without;
    cv::Mat with;
    renderer.draw(std::vector<HandPose>{}, 0, without);
    renderer.draw(frame.hands, 0, with);
    const double x_mm = frame.hands[0].finger.foot.x_mm;
    const ImagePoint border = camera_of(rig.settings).project({x_mm, rig.settings.screen.height_mm, 0});
    cv::Mat change;
    cv::absdiff(with, without, change);
    const cv::Rect below(0, static_cast<int>(border.v_px), with.cols, 3);
    EXPECT_GT(cv::norm(change(below & cv::Rect({0, 0}, with.size())), cv::NORM_INF), 20) << seed;
    // Nothing touches: all of it stays in front of the screen.
    const HandShape shape = hand_shape(frame.hands[0], *frame.hands[0].looks);
    for (const MeshVertex& vertex : shape.mesh.vertices)
      ASSERT_GT(vertex.place_mm[2] + shape.place_for(frame.hands[0].finger)[2], 0.3F) << seed;
  }
}

TEST(RandomGestures, MakeAScriptThatCanBePlayed) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const VirtualRigSettings s = random_rig(seed).settings;
    EXPECT_EQ(s.script.touches.size(), 8u);
    for (const ScriptedTouch& touch : s.script.touches) {
      const std::vector<HandPose> hands = hands_at(s.script, (touch.begin_s + touch.end_s) / 2);
      ASSERT_EQ(hands.size(), 1u);
      EXPECT_EQ(hands[0].finger.hover_mm, 0);
      EXPECT_EQ(hands[0].second.has_value(), touch.beside.has_value());
    }
  }
}

}  // namespace
}  // namespace telehug
