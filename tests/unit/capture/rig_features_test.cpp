// SPDX-License-Identifier: Apache-2.0
//
// What the settings of a virtual rig promise is seen in its pictures.
#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "capture/virtual_rig/mirror_contrast.hpp"
#include "capture/virtual_rig/picture_maker.hpp"
#include "capture/virtual_rig/rig_renderer.hpp"

namespace telehug {
namespace {

VirtualRigSettings plain_rig() {
  VirtualRigSettings settings;
  settings.image = {640, 360};
  settings.focal_px = 550;
  settings.noise_sd = 0;
  settings.content = ScreenContent::black;
  settings.coat.mirror = 0;
  return settings;
}

HandPose touch_at(double x_mm, double y_mm) {
  HandPose pose;
  pose.finger = {{x_mm, y_mm}, 0};
  return pose;
}

cv::Mat picture(const VirtualRigSettings& settings, const std::vector<HandPose>& hands = {}) {
  RigRenderer renderer(settings);
  cv::Mat bgr;
  renderer.draw(hands, 0, bgr);
  return bgr;
}

double tone(const cv::Mat& bgr, const cv::Rect& box) {
  const cv::Scalar mean = cv::mean(bgr(box));
  return (mean[0] + mean[1] + mean[2]) / 3;
}

// First row from below, in a column, where it is brighter than the black screen.
int border_row(const cv::Mat& bgr, int column) {
  for (int v = bgr.rows - 1; v > 0; --v) {
    if (bgr.at<cv::Vec3b>(v, column)[1] > 90) return v;
  }
  return 0;
}

TEST(RigFeatures, DistortionBendsTheScreensBorderByItsFormula) {
  VirtualRigSettings settings = plain_rig();
  settings.bezel_tint = {220, 220, 220};
  settings.bezel_raised_mm = 0;
  settings.sensor.blur_px = 0;
  for (const double k1 : {-0.08, 0.0, 0.08}) {
    settings.distortion_k1 = k1;
    const cv::Mat bgr = picture(settings);
    for (const int column : {40, 200, 320, 500, 600}) {
      // The border is straight at y_u = z0 / (H - y0) focal lengths; at its undistorted x it moves by 1 + k1 r^2.
      const double y_u = 50.0 / 315;
      double x_u = (column - 319.5) / 550;
      for (int i = 0; i < 20; ++i)
        x_u = (column - 319.5) / 550 / (1 + k1 * (x_u * x_u + y_u * y_u));
      const double v = 179.5 + 550 * y_u * (1 + k1 * (x_u * x_u + y_u * y_u));
      EXPECT_NEAR(border_row(bgr, column) + 0.5, v, 1.1) << k1 << ", " << column;
    }
  }
}

TEST(RigFeatures, BezelLightAndExposureChangeBrightnessAsTheyShould) {
  VirtualRigSettings settings = plain_rig();
  const cv::Rect desk(20, 120, 100, 60);
  const double usual = tone(picture(settings), desk);
  settings.light.level = 0.25;
  EXPECT_NEAR(tone(picture(settings), desk), usual / 2, 2);  // a picture holds the root of the light
  settings.sensor.exposure = 4;
  EXPECT_NEAR(tone(picture(settings), desk), usual, 2);
  settings.light.colour = {0.5, 1, 1};
  const cv::Scalar warm = cv::mean(picture(settings)(desk));
  EXPECT_LT(warm[0], 0.8 * usual);
}

TEST(RigFeatures, AutomaticExposureFollowsTheScreen) {
  VirtualRigSettings settings = plain_rig();
  settings.sensor.auto_exposure = 0.8;
  const cv::Rect desk(20, 120, 100, 60);
  const double with_black = tone(picture(settings), desk);
  settings.content = ScreenContent::white;
  EXPECT_LT(tone(picture(settings), desk), with_black - 5);
}

TEST(RigFeatures, AGlossyScreenMirrorsSharplyAndAMattOneBlurred) {
  VirtualRigSettings settings = plain_rig();
  settings.coat.mirror = 1;
  settings.desk.tint = {230, 230, 230};
  settings.desk.foot_tint = {20, 20, 20};
  // The steepest step from desk to foot in a row of the screen.
  const auto steepest = [&](double roughness_deg) {
    settings.coat.roughness_deg = roughness_deg;
    const cv::Mat bgr = picture(settings);
    int most = 0;
    for (int u = 100; u < 540; ++u)
      most = std::max(most, std::abs(bgr.at<cv::Vec3b>(300, u + 1)[1] - bgr.at<cv::Vec3b>(300, u)[1]));
    return most;
  };
  const int glossy = steepest(0.02);
  EXPECT_GT(glossy, 15);
  EXPECT_LT(steepest(5), glossy / 2);
}

TEST(RigFeatures, FresnelReflectionOfGlassIsFourPercentStraightOnAndAllOfItAtTheEdge) {
  EXPECT_NEAR(fresnel(1), 0.04, 1e-4);
  EXPECT_NEAR(fresnel(0), 1, 1e-4);
  EXPECT_NEAR(fresnel(std::cos(75.0F * 3.14159F / 180)), 0.2534, 0.002);  // Hecht, Optics, table of glass 1.5
}

TEST(RigFeatures, AMirroredFingerMeetsTheFingerWhereItTouches) {
  VirtualRigSettings settings = plain_rig();
  settings.coat.mirror = 1;
  settings.coat.roughness_deg = 0.02;
  const cv::Mat without = picture(settings);
  const cv::Mat with = picture(settings, {touch_at(190, 250)});
  const PinholeCamera camera(settings.camera, settings.focal_px, settings.image);
  const ImagePoint p = camera.project({190, 250, 0});
  const auto change = [&](int dv) {
    const cv::Rect box(static_cast<int>(p.u_px) - 2, static_cast<int>(p.v_px) + dv, 5, 3);
    return std::abs(tone(with, box) - tone(without, box));
  };
  EXPECT_GT(change(-20), 40);  // finger
  EXPECT_GT(change(15), 10);   // its image
}

TEST(RigFeatures, SkinTonesGrowDarkerAndAWhiteScreenLightsTheFingertip) {
  VirtualRigSettings settings = plain_rig();
  const PinholeCamera camera(settings.camera, settings.focal_px, settings.image);
  const ImagePoint tip = camera.project({190, 200, 0});
  const cv::Rect nail(static_cast<int>(tip.u_px) - 3, static_cast<int>(tip.v_px) - 40, 7, 7);
  double lighter = 256;
  for (int skin = 1; skin <= 6; ++skin) {
    settings.hand.skin_tone = skin;
    const double now = tone(picture(settings, {touch_at(190, 200)}), nail);
    EXPECT_LT(now, lighter - 5) << skin;
    lighter = now;
  }
  const cv::Rect pad(static_cast<int>(tip.u_px) - 2, static_cast<int>(tip.v_px) - 4, 5, 2);
  const double dark = tone(picture(settings, {touch_at(190, 200)}), pad);
  settings.content = ScreenContent::white;
  EXPECT_GT(tone(picture(settings, {touch_at(190, 200)}), pad), dark + 15);
}

TEST(RigFeatures, PolishRingAndSleeveAreSeen) {
  const VirtualRigSettings bare = plain_rig();
  const cv::Mat usual = picture(bare, {touch_at(190, 200)});
  const auto changed = [&](auto&& change) {
    VirtualRigSettings settings = plain_rig();
    change(settings.hand);
    cv::Mat difference;
    cv::absdiff(picture(settings, {touch_at(190, 200)}), usual, difference);
    return cv::countNonZero(difference.reshape(1) > 25) / 3;
  };
  EXPECT_GT(changed([](HandLooks& hand) { hand.polish = cv::Vec3d(200, 40, 20); }), 100);
  EXPECT_GT(changed([](HandLooks& hand) { hand.ring = true; }), 20);
  EXPECT_GT(changed([](HandLooks& hand) { hand.nail_mm = 10; }), 40);
  EXPECT_GT(changed([](HandLooks& hand) { hand.sleeve = Sleeve::glove; }), 3000);
  EXPECT_GT(changed([](HandLooks& hand) { hand.finger_width_mm = 20; }), 1500);
}

TEST(RigFeatures, WhereSkinMeetsTheScreenItMayBeShaded) {
  VirtualRigSettings settings = plain_rig();
  const PinholeCamera camera(settings.camera, settings.focal_px, settings.image);
  const ImagePoint tip = camera.project({190, 200, 0});
  const cv::Rect pad(static_cast<int>(tip.u_px) - 2, static_cast<int>(tip.v_px) - 4, 5, 2);
  const cv::Rect nail(static_cast<int>(tip.u_px) - 3, static_cast<int>(tip.v_px) - 40, 7, 7);
  const cv::Mat usual = picture(settings, {touch_at(190, 200)});
  settings.light.contact_shade = 0.8;
  const cv::Mat shaded = picture(settings, {touch_at(190, 200)});
  EXPECT_LT(tone(shaded, pad), 0.85 * tone(usual, pad));
  EXPECT_GT(tone(shaded, nail), 0.95 * tone(usual, nail));
}

TEST(RigFeatures, AHandThrowsAShadowOntoTheDesk) {
  VirtualRigSettings settings = plain_rig();
  settings.light.towards = {-1, -1, 0.3};  // from the user's left: the shadow falls to the right, left in the picture
  settings.light.directed = 0.6;
  settings.desk.foot_half_width_mm = 0;
  cv::Mat darker;
  cv::subtract(picture(settings), picture(settings, {touch_at(240, 200)}), darker);
  EXPECT_GT(cv::countNonZero(darker(cv::Rect(0, 0, 150, 240)).clone().reshape(1) > 10), 1000);
}

TEST(RigFeatures, DisturbancesShowAndEnd) {
  VirtualRigSettings settings = plain_rig();
  settings.disturbances = {{DisturbanceKind::lights, 1, 2, 0.2},       {DisturbanceKind::screen_flash, 3, 4, 0},
                           {DisturbanceKind::bump, 5, 6, 1.5},         {DisturbanceKind::black_frames, 7, 8, 0},
                           {DisturbanceKind::torn_frames, 9, 10, 0.5}, {DisturbanceKind::frozen, 11, 12, 0}};
  PictureMaker maker(settings);
  cv::Mat usual;
  cv::Mat bgr;
  maker.draw({}, 0, 0, usual);
  const auto at = [&](double time_s, const std::vector<HandPose>& hands = {}) {
    maker.draw(hands, time_s, 1, bgr);
    return cv::norm(bgr, usual, cv::NORM_INF);
  };
  EXPECT_EQ(at(0.5), 0);
  EXPECT_GT(at(1.5), 40);
  EXPECT_GT(at(3.5), 100);
  EXPECT_GT(at(5.5), 20);  // edges moved
  EXPECT_EQ(at(6.5), 0);
  at(7.5);
  EXPECT_EQ(cv::norm(bgr, cv::NORM_INF), 0);
  at(8.5);
  const std::vector<HandPose> hand{touch_at(190, 200)};
  EXPECT_GT(at(9.5, hand), 40);
  EXPECT_EQ(cv::norm(bgr.rowRange(180, 360), usual.rowRange(180, 360), cv::NORM_INF), 0);  // of the picture before
  EXPECT_EQ(at(10.5), 0);
  EXPECT_EQ(at(11.5, hand), 0);
}

TEST(RigFeatures, AMovingScreenChangesInItsWindowOnly) {
  for (const ScreenMotion motion :
       {ScreenMotion::scrolling, ScreenMotion::fading, ScreenMotion::rectangle, ScreenMotion::flashing}) {
    VirtualRigSettings settings = plain_rig();
    settings.content = ScreenContent::photo;
    settings.motion = motion;
    RigRenderer renderer(settings);
    cv::Mat before;
    cv::Mat after;
    cv::Mat again;
    renderer.draw(std::vector<HandPose>{}, 0, before);
    renderer.move_screen(0.3);
    renderer.draw(std::vector<HandPose>{}, 0, after);
    EXPECT_GT(cv::norm(after, before, cv::NORM_INF), 15) << static_cast<int>(motion);
    EXPECT_EQ(cv::norm(after.rowRange(0, 250), before.rowRange(0, 250), cv::NORM_INF), 0);  // desk and bezel
    renderer.move_screen(0);
    renderer.draw(std::vector<HandPose>{}, 0, again);
    EXPECT_EQ(cv::norm(again, before, cv::NORM_INF), 0);
  }
}

TEST(RigFeatures, AViewWithAnotherPictureIsAsIfMadeAnew) {
  VirtualRigSettings settings = plain_rig();
  settings.coat.mirror = 0.5;
  RigRenderer renderer(settings);
  settings.content = ScreenContent::photo;
  renderer.show(renderer.view(settings));
  cv::Mat bgr;
  renderer.draw(std::vector{touch_at(190, 200)}, 0, bgr);
  EXPECT_EQ(cv::norm(bgr, picture(settings, {touch_at(190, 200)}), cv::NORM_INF), 0);
}

TEST(RigFeatures, APictureDoesNotDependOnTheHandsBeforeIt) {
  const VirtualRigSettings settings = plain_rig();
  RigRenderer renderer(settings);
  cv::Mat bgr;
  renderer.draw(std::vector{touch_at(150, 180)}, 0, bgr);
  renderer.draw(std::vector{touch_at(230, 250)}, 0, bgr);
  EXPECT_EQ(cv::norm(bgr, picture(settings, {touch_at(230, 250)}), cv::NORM_INF), 0);
  renderer.draw(std::vector<HandPose>{}, 0, bgr);
  EXPECT_EQ(cv::norm(bgr, picture(settings), cv::NORM_INF), 0);
}

TEST(RigFeatures, AMovingHandIsBlurredAlongItsWayAndNowhereElse) {
  VirtualRigSettings settings = plain_rig();
  settings.content = ScreenContent::white;
  settings.hand.skin_tone = 6;
  // The steepest step across the finger's left or right edge, on the screen.
  const auto steepest = [&](const HandPose& hand) {
    const cv::Mat bgr = picture(settings, {hand});
    int most = 0;
    for (int u = 100; u < 540; ++u)
      most = std::max(most, std::abs(bgr.at<cv::Vec3b>(290, u + 1)[1] - bgr.at<cv::Vec3b>(290, u)[1]));
    return most;
  };
  HandPose hand = touch_at(190, 200);
  const int still = steepest(hand);
  hand.velocity_mm_per_s = {250, 0, 0};
  EXPECT_EQ(steepest(hand), still);  // no time, no way
  settings.sensor.shutter_s = 1.0 / 30;
  EXPECT_LT(steepest(hand), still / 3);
  hand.velocity_mm_per_s = {0, 0, 0};
  EXPECT_EQ(steepest(hand), still);
}

TEST(RigFeatures, AMovingHandIsSeenWhereItIsInTheMiddleOfTheExposure) {
  VirtualRigSettings settings = plain_rig();
  settings.content = ScreenContent::white;
  settings.hand.skin_tone = 6;
  const cv::Mat empty = picture(settings);
  const auto middle_of_finger = [&](double velocity) {
    HandPose hand = touch_at(190, 200);
    hand.velocity_mm_per_s = {velocity, 0, 0};
    const cv::Mat bgr = picture(settings, {hand});
    double sum = 0;
    double moment = 0;
    for (int u = 200; u < 440; ++u) {
      const double change = empty.at<cv::Vec3b>(290, u)[1] - bgr.at<cv::Vec3b>(290, u)[1];
      sum += change;
      moment += change * u;
    }
    return moment / sum;
  };
  settings.sensor.shutter_s = 1.0 / 30;
  EXPECT_NEAR(middle_of_finger(250), middle_of_finger(0), 0.7);
  EXPECT_NEAR(middle_of_finger(-250), middle_of_finger(0), 0.7);
}

TEST(RigFeatures, JpegLeavesItsMarks) {
  VirtualRigSettings settings = plain_rig();
  settings.content = ScreenContent::desktop;
  const cv::Mat clean = picture(settings);
  settings.sensor.jpeg_quality = 30;
  EXPECT_GT(cv::norm(picture(settings), clean, cv::NORM_INF), 10);
}

TEST(RigFeatures, EveryScreenContentLooksDifferent) {
  VirtualRigSettings settings = plain_rig();
  std::vector<cv::Mat> pictures;
  for (const ScreenContent content : {ScreenContent::gradient, ScreenContent::black, ScreenContent::white,
                                      ScreenContent::chat, ScreenContent::photo, ScreenContent::desktop}) {
    settings.content = content;
    pictures.push_back(picture(settings));
  }
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_GT(cv::norm(pictures[i], pictures[j], cv::NORM_INF), 15) << i << ", " << j;
  }
}

TEST(RigFeatures, AMirrorImageStandsOutOnABlackMirrorButNotOnAWhiteOneNorOnAMattScreen) {
  HandPose hovering = touch_at(190, 200);
  hovering.finger.hover_mm = 15;
  const auto contrast = [&](ScreenContent content, double mirror, double roughness_deg) {
    VirtualRigSettings settings = plain_rig();
    settings.content = content;
    settings.screen_luminance = 3;
    settings.coat.mirror = mirror;
    settings.coat.roughness_deg = roughness_deg;
    RigRenderer renderer(settings);
    return mirror_contrast(renderer, {hovering});
  };
  EXPECT_GT(contrast(ScreenContent::black, 1, 0), 2 * least_mirror_contrast);
  EXPECT_LT(contrast(ScreenContent::white, 1, 0), least_mirror_contrast);
  EXPECT_LT(contrast(ScreenContent::black, 0.1, 8), least_mirror_contrast);
  EXPECT_EQ(contrast(ScreenContent::black, 0, 0), 0);
}

TEST(RigFeatures, LookingForAMirrorImageLeavesTheNextPictureAsItWas) {
  VirtualRigSettings settings = plain_rig();
  settings.coat.mirror = 1;
  settings.coat.roughness_deg = 0;
  RigRenderer renderer(settings);
  cv::Mat before;
  cv::Mat after;
  renderer.draw({touch_at(190, 200)}, 1, before);
  (void)mirror_contrast(renderer, {touch_at(190, 200)});
  EXPECT_EQ(mirror_contrast(renderer, std::vector<HandPose>{}), 0);
  renderer.draw({touch_at(190, 200)}, 1, after);
  EXPECT_EQ(cv::norm(before, after, cv::NORM_INF), 0);
}

}  // namespace
}  // namespace telehug
