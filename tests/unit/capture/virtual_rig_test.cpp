// SPDX-License-Identifier: Apache-2.0
#include "capture/virtual_rig/virtual_rig.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "doubles/fake_clock.hpp"

namespace telehug {
namespace {

using ::testing::HasSubstr;

// A third of the default's resolution, so that a test is quick.
VirtualRigSettings small_rig() {
  VirtualRigSettings settings;
  settings.image = {640, 360};
  settings.focal_px = 550;
  return settings;
}

// Row (v) of the lowest pixel that the finger changes, to a fraction of a pixel: where the change of the column's
// pixels falls to half of what it is on the finger.
ImagePoint lowest_of_finger(const cv::Mat& with, const cv::Mat& without) {
  cv::Mat difference;
  cv::absdiff(with, without, difference);
  const auto change = [&](int v, int u) {
    const cv::Vec3b& d = difference.at<cv::Vec3b>(v, u);
    return static_cast<double>(d[0] + d[1] + d[2]);
  };
  ImagePoint lowest{0, 0};
  for (int u = 0; u < with.cols; ++u) {
    for (int v = with.rows - 2; v > lowest.v_px; --v) {
      const double above = change(v - 3 < 0 ? 0 : v - 3, u);
      if (change(v, u) < above / 2 || above < 60) continue;
      const double here = change(v, u);
      const double below = change(v + 1, u);
      if (here > below) lowest = {static_cast<double>(u), v + std::min(1.0, (here - above / 2) / (here - below))};
      break;
    }
  }
  return lowest;
}

// The picture of a point for a camera that looks straight down, by hand: u = u0 - f (x - x0) / (y - y0),
// v = v0 + f z0 / (y - y0), and for points in front of the screen z0 - z in place of z0.
ImagePoint projected_by_hand(double x_mm, double y_mm, double z_mm) {
  return {639.5 - 1100 * (x_mm - 190) / (y_mm + 15), 359.5 + 1100 * (50 - z_mm) / (y_mm + 15)};
}

TEST(VirtualRig, DrawsTheFingertipWhereTheTruthSaysThatItTouches) {
  VirtualRigSettings settings;
  settings.coat.mirror = 0;
  settings.noise_sd = 0;
  settings.content = ScreenContent::white;  // a dark finger stands out from it all around
  settings.hand.skin_tone = 6;
  settings.sensor.blur_px = 0;
  RigRenderer renderer(settings);
  cv::Mat without;
  cv::Mat with;
  renderer.draw(std::nullopt, 0, without);
  for (const ScreenPoint contact : {ScreenPoint{190, 200}, {150, 180}, {230, 250}, {120, 230}, {250, 210}}) {
    HandPose pose;
    pose.finger = {contact, 0};
    renderer.draw(std::vector{pose}, 0, with);
    const ImagePoint tip = lowest_of_finger(with, without);
    const HandShape shape = hand_shape(pose, settings.hand);
    const cv::Vec3f place = shape.place_for(pose.finger);
    ImagePoint lowest{0, 0};
    for (const MeshVertex& vertex : shape.mesh.vertices) {
      const cv::Vec3f p = vertex.place_mm + place;
      const ImagePoint image = projected_by_hand(static_cast<double>(p[0]), static_cast<double>(p[1]),
                                                 std::max(0.0, static_cast<double>(p[2])));
      if (image.v_px > lowest.v_px) lowest = image;
    }
    EXPECT_NEAR(tip.v_px, lowest.v_px, 1) << contact.x_mm << ", " << contact.y_mm;
    EXPECT_NEAR(tip.u_px, lowest.u_px, 12);  // the outline is nearly level there
    // The camera sees the pad's outline, which lies before the middle of what touches: 0.3 to 4 mm on the screen.
    const ImagePoint truth = projected_by_hand(contact.x_mm, contact.y_mm, 0);
    const double row_mm = (contact.y_mm + 15) * (contact.y_mm + 15) / (1100 * 50);
    EXPECT_NEAR((truth.v_px - tip.v_px) * row_mm, -2, 2.5);
    EXPECT_NEAR(tip.u_px, truth.u_px, 25);
  }
}

TEST(VirtualRig, TellsTheTruthOfEveryFrame) {
  FakeClock clock;
  VirtualRigSettings settings = small_rig();
  settings.script = {{{1.0, 2.0, {150, 200}, {150, 200}}}, 4.0};
  const VirtualRig rig(settings, clock);
  EXPECT_FALSE(rig.truth(0).contact);
  EXPECT_FALSE(rig.truth(0).screen.has_value());
  EXPECT_FALSE(rig.truth(28).contact);
  EXPECT_GT(rig.truth(28).hover_mm.value_or(0), 0);
  for (const std::uint64_t frame : {30u, 45u, 60u, 30u + 120u}) {  // the script repeats after 120 frames
    EXPECT_TRUE(rig.truth(frame).contact) << frame;
    EXPECT_EQ(rig.truth(frame).screen->y_mm, 200);
    EXPECT_FALSE(rig.truth(frame).hover_mm.has_value());
  }
}

TEST(VirtualRig, GivesTheSamePicturesForTheSameSeedOnly) {
  FakeClock clock;
  VirtualRigSettings settings = small_rig();
  settings.real_time = false;
  VirtualRig a(settings, clock);
  VirtualRig b(settings, clock);
  (void)b.picture_of_touch({190, 200});  // leaves the frames as they are
  settings.seed = 2;
  VirtualRig c(settings, clock);
  Frame of_a;
  Frame of_b;
  Frame of_c;
  for (VirtualRig* rig : {&a, &b, &c})
    ASSERT_TRUE(rig->open());
  cv::Mat before;
  for (int i = 0; i < 30; ++i) {
    ASSERT_EQ(a.read(of_a, 0ms), ReadOutcome::frame);
    ASSERT_EQ(b.read(of_b, 0ms), ReadOutcome::frame);
    ASSERT_EQ(c.read(of_c, 0ms), ReadOutcome::frame);
    EXPECT_EQ(of_a.sequence, static_cast<std::uint64_t>(i));
    EXPECT_EQ(cv::norm(of_a.bgr, of_b.bgr, cv::NORM_INF), 0);
    EXPECT_GT(cv::norm(of_a.bgr, of_c.bgr, cv::NORM_INF), 0);
    if (i > 0) {
      EXPECT_GT(cv::norm(of_a.bgr, before, cv::NORM_INF), 0);
    }
    of_a.bgr.copyTo(before);
  }
}

TEST(VirtualRig, KeepsToTheClockAndGivesALateReaderTheNewestPicture) {
  FakeClock clock;
  VirtualRig rig(small_rig(), clock, [&](Timestamp until) { clock.advance(until - clock.now()); });
  const Timestamp begin = clock.now();
  ASSERT_TRUE(rig.open());
  Frame frame;
  ASSERT_EQ(rig.read(frame, 1s), ReadOutcome::frame);
  EXPECT_EQ(frame.time, begin);
  EXPECT_EQ(rig.read(frame, 10ms), ReadOutcome::timeout);
  ASSERT_EQ(rig.read(frame, 1s), ReadOutcome::frame);
  EXPECT_EQ(frame.sequence, 1u);
  EXPECT_NEAR(to_ms(clock.now() - begin), 1000 / 30.0, 0.001);
  clock.advance(1s);
  ASSERT_EQ(rig.read(frame, 1s), ReadOutcome::frame);
  EXPECT_EQ(frame.sequence, 31u);
  EXPECT_LE(frame.time, clock.now());
}

TEST(VirtualRig, EndsAfterItsScriptUnlessItRepeats) {
  FakeClock clock;
  VirtualRigSettings settings = small_rig();
  settings.real_time = false;
  settings.repeat = false;
  settings.script = {{{0.3, 0.4, {150, 200}, {150, 200}}}, 0.7};
  VirtualRig rig(settings, clock);
  ASSERT_TRUE(rig.open());
  Frame frame;
  int frames = 0;
  while (rig.read(frame, 0ms) == ReadOutcome::frame)
    ++frames;
  EXPECT_EQ(frames, 22);  // 0 to 0.7 s
  EXPECT_EQ(rig.read(frame, 0ms), ReadOutcome::ended);
}

TEST(VirtualRig, ShowsItsScreenAndTheMirrorImageOfTheFinger) {
  VirtualRigSettings settings = small_rig();
  settings.noise_sd = 0;
  settings.screen_picture = cv::Mat(10, 10, CV_8UC3, cv::Scalar(0, 160, 0));
  RigRenderer renderer(settings);
  cv::Mat empty;
  renderer.draw(std::nullopt, 0, empty);
  const cv::Vec3b screen = empty.at<cv::Vec3b>(330, 320);
  EXPECT_GT(screen[1], screen[0] + 80);
  cv::Mat touched;
  renderer.draw(FingerPlace{{190, 250}, 0}, 0, touched);
  const ImagePoint tip = renderer.camera().project({190, 250, 0});
  const auto below = cv::Point(static_cast<int>(tip.u_px), static_cast<int>(tip.v_px) + 12);
  EXPECT_GT(touched.at<cv::Vec3b>(below)[2], empty.at<cv::Vec3b>(below)[2] + 3);
}

TEST(VirtualRig, OffersCalibrationPointsThatTheCameraSees) {
  const VirtualRigSettings settings;
  const std::vector<ScreenPoint> points = calibration_points(settings);
  ASSERT_EQ(points.size(), 9u);
  EXPECT_EQ(points[0].x_mm, 190);
  EXPECT_EQ(points[1].x_mm, 220);
  EXPECT_GT(points[1].y_mm, points[0].y_mm);
  const PinholeCamera camera(settings.camera, settings.focal_px, settings.image);
  for (const ScreenPoint& point : points) {
    const ImagePoint p = camera.project({point.x_mm, point.y_mm, 0});
    EXPECT_TRUE(p.u_px > 0 && p.u_px < 1279 && p.v_px > 0 && p.v_px < 719);
  }
}

TEST(VirtualRig, RefusesSettingsThatCantBeDrawnAndSaysWhy) {
  FakeClock clock;
  VirtualRigSettings overlapping = small_rig();
  overlapping.script = {{{1, 2, {100, 200}, {100, 200}}, {2.1, 3, {100, 200}, {100, 200}}}, 5};
  EXPECT_THAT(check_virtual_rig(overlapping).error().message, HasSubstr("touch at 2.1 s begins before"));
  VirtualRigSettings beside = small_rig();
  beside.script = {{{1, 2, {400, 200}, {100, 200}}}, 5};
  EXPECT_THAT(check_virtual_rig(beside).error().message, HasSubstr("not on the screen"));
  VirtualRigSettings endless = small_rig();
  endless.fps = std::nan("");
  EXPECT_FALSE(check_virtual_rig(endless));
  EXPECT_THROW(VirtualRig(endless, clock), std::invalid_argument);
  EXPECT_TRUE(check_virtual_rig(small_rig()));
}

}  // namespace
}  // namespace telehug
