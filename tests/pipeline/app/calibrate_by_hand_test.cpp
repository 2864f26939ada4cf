// SPDX-License-Identifier: Apache-2.0
//
// A person who does what `telehug-active calibrate` asks for, before the virtual rig's camera.
#include "commands/calibrate_by_hand.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <istream>
#include <opencv2/core.hpp>
#include <optional>
#include <sstream>
#include <streambuf>

#include "calibration/calibration_page.hpp"
#include "calibration/calibration_policy.hpp"
#include "capture/virtual_rig/virtual_rig.hpp"
#include "common/clock.hpp"
#include "doubles/perfect_calibration.hpp"
#include "doubles/temporary_folder.hpp"
#include "pictures/picture_file.hpp"

namespace telehug {
namespace {

using testing::HasSubstr;

// Shows one picture until the next one is wanted.
class PatientCamera : public FrameSource {
 public:
  explicit PatientCamera(std::vector<cv::Mat> pictures) : pictures_(std::move(pictures)) {}

  Status open() override { return Done{}; }
  void close() override {}
  [[nodiscard]] bool is_open() const override { return true; }
  ReadOutcome read(Frame& frame, Duration /*timeout*/) override {
    if (shown_ == 0 || shown_ > pictures_.size()) return ReadOutcome::timeout;
    frame.bgr = pictures_[shown_ - 1];
    return ReadOutcome::frame;
  }
  [[nodiscard]] std::string last_error() const override { return ""; }
  [[nodiscard]] std::string name() const override { return "patient camera"; }
  [[nodiscard]] ImageSize size() const override { return {pictures_[0].cols, pictures_[0].rows}; }

  void show_next() { ++shown_; }
  [[nodiscard]] std::size_t shown() const { return shown_; }

 private:
  std::vector<cv::Mat> pictures_;
  std::size_t shown_ = 0;
};

// Presses Enter whenever asked, having done what was asked for.
class ObedientPerson : public std::streambuf {
 public:
  explicit ObedientPerson(PatientCamera& camera) : camera_(camera) {}

 protected:
  int_type underflow() override {
    camera_.show_next();
    setg(&enter_, &enter_, &enter_ + 1);
    return traits_type::to_int_type(enter_);
  }

 private:
  PatientCamera& camera_;
  char enter_ = '\n';
};

class CalibratingByHand : public testing::Test {
 protected:
  CalibratingByHand() { std::filesystem::current_path(folder.path()); }
  ~CalibratingByHand() override { std::filesystem::current_path(before); }

  std::vector<cv::Mat> pictures(const std::vector<ScreenPoint>& touched, bool with_marks = true) {
    std::vector<cv::Mat> found{rig.picture_of_triangle(), rig.picture_of_background()};
    if (with_marks) found.push_back(rig.picture_of_marks());
    for (const ScreenPoint& point : touched)
      found.push_back(rig.picture_of_touch(point));
    return found;
  }
  Result<CalibratedRig> calibrate(const std::string& model) {
    ObedientPerson person(*camera);
    std::istream answers(&person);
    return calibrate_by_hand(*camera, {rig.settings().screen, model, {}}, "2026-01-01T00:00:00Z", answers, asked);
  }

  const std::filesystem::path before = std::filesystem::current_path();
  TemporaryFolder folder;
  const SteadyClock clock;
  VirtualRig rig{VirtualRigSettings{}, clock};
  const std::vector<ScreenPoint> points = default_points(rig.settings().screen);
  std::optional<PatientCamera> camera;
  std::ostringstream asked;
};

TEST_F(CalibratingByHand, FindsTheCameraAndKeepsTheEmptyRig) {
  camera.emplace(pictures(points));
  const auto found = calibrate("default");
  ASSERT_TRUE(found.ok()) << found.error().message;
  const auto& solved = std::get<RigCalibration>(found->calibration.solved);
  EXPECT_TRUE(judge_calibration(solved, points).good());
  for (const ScreenPoint& at : points) {
    const auto placed = solved.solution.model.camera.screen_point(camera_of(rig.settings()).project(at).value());
    ASSERT_TRUE(placed.has_value());
    EXPECT_NEAR(placed->x_mm, at.x_mm, 0.3);
    EXPECT_NEAR(placed->y_mm, at.y_mm, 0.5);
  }
  const double cells = 3.0 * found->empty->cols * found->empty->rows;
  EXPECT_LT(cv::norm(*found->empty, rig.picture_of_background(), cv::NORM_L1) / cells, 5);
}

TEST_F(CalibratingByHand, WritesAPictureForEachStepInTheirOrder) {
  camera.emplace(pictures(points));
  ASSERT_TRUE(calibrate("default").ok());
  const std::string said = asked.str();
  std::size_t at = 0;
  for (const char* page :
       {"01-triangle", "02-black", "03-marks", "04-dot-1", "05-dot-2", "06-dot-3", "07-dot-4", "08-dot-5"}) {
    at = said.find(std::string("telehug-calibration/") + page + ".png", at);
    ASSERT_NE(at, std::string::npos) << page << " in " << said;
  }
  const auto dot = read_picture("telehug-calibration/05-dot-2.png");
  ASSERT_TRUE(dot.ok()) << dot.error().message;
  const ScreenSize& screen = rig.settings().screen;
  const int u = static_cast<int>(std::lround(points[1].x_mm / screen.width_mm * dot->cols));
  const int v = static_cast<int>(std::lround(points[1].y_mm / screen.height_mm * dot->rows));
  EXPECT_EQ(dot->at<cv::Vec3b>(v, u), cv::Vec3b(255, 255, 255));
  EXPECT_EQ(dot->at<cv::Vec3b>(v, u + dot->cols / 10), cv::Vec3b(0, 0, 0));
}

TEST_F(CalibratingByHand, ShowsMarksWhereTheyAreLookedFor) {
  camera.emplace(pictures(points));
  const auto found = calibrate("default");
  ASSERT_TRUE(found.ok()) << found.error().message;
  // The triangle's vertex is one more.
  EXPECT_GE(std::get<RigCalibration>(found->calibration.solved).observations.marks.size(), 9U);
  const auto page = read_picture("telehug-calibration/03-marks.png");
  ASSERT_TRUE(page.ok()) << page.error().message;
  const ScreenSize& screen = rig.settings().screen;
  std::size_t white = 0;
  for (const ScreenPoint& mark : mark_points(screen)) {
    const int u = static_cast<int>(mark.x_mm / screen.width_mm * page->cols);
    const int v = static_cast<int>(mark.y_mm / screen.height_mm * page->rows);
    if (page->at<cv::Vec3b>(v, u) == cv::Vec3b(255, 255, 255)) ++white;
  }
  EXPECT_EQ(white, mark_points(screen).size());
  // And nothing else is white.
  const double dots_share = static_cast<double>(white) * 78.5 / (screen.width_mm * screen.height_mm);
  EXPECT_NEAR(cv::mean(*page)[0] / 255, dots_share, 0.1 * dots_share);
}

TEST_F(CalibratingByHand, AsksAgainForATouchThatDoesNotFit) {
  // At the last three nobody touches; then each is done as it should have been.
  std::vector<cv::Mat> shown = pictures(points);
  shown[5] = shown[6] = shown[7] = shown[1];
  shown.push_back(rig.picture_of_touch(points[2]));
  shown.push_back(rig.picture_of_touch(points[3]));
  shown.push_back(rig.picture_of_touch(points[4]));
  camera.emplace(shown);
  const auto found = calibrate("default");
  ASSERT_TRUE(found.ok()) << found.error().message;
  EXPECT_THAT(
      asked.str(),
      HasSubstr("The touch of dot 3 was not seen, or does not fit the others. Show telehug-calibration/06-dot-3"));
  EXPECT_EQ(std::get<RigCalibration>(found->calibration.solved).observations.touches.size(), points.size());
  EXPECT_EQ(camera->shown(), shown.size());
}

TEST_F(CalibratingByHand, SolvesTheThesisModelFromTwoTouches) {
  camera.emplace(pictures(thesis_points(rig.settings().screen), false));
  const auto found = calibrate("thesis");
  ASSERT_TRUE(found.ok()) << found.error().message;
  EXPECT_STREQ(found->calibration.model_name(), "thesis");
  EXPECT_EQ(camera->shown(), 4U);
  EXPECT_TRUE(std::filesystem::exists("telehug-calibration/03-dot-1.png"));
  EXPECT_FALSE(std::filesystem::exists("telehug-calibration/03-marks.png"));
}

TEST_F(CalibratingByHand, EndsIfNobodyAnswers) {
  camera.emplace(pictures(points));
  std::istringstream nobody;
  const auto found = calibrate_by_hand(*camera, {rig.settings().screen, "default", {}}, "", nobody, asked);
  ASSERT_FALSE(found.ok());
  EXPECT_THAT(found.error().message, HasSubstr("run it in a terminal"));
}

TEST_F(CalibratingByHand, SaysThatTheCameraIsSilent) {
  std::vector<cv::Mat> only_triangle = pictures({});
  only_triangle.pop_back();
  camera.emplace(only_triangle);
  const auto found = calibrate("default");
  ASSERT_FALSE(found.ok());
  EXPECT_THAT(found.error().message, HasSubstr("patient camera delivers no pictures: it is silent"));
}

}  // namespace
}  // namespace telehug
