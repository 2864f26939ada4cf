// SPDX-License-Identifier: Apache-2.0
//
// A person who does what `telehug-active calibrate` asks for, before the virtual rig's camera.
#include "commands/calibrate_by_hand.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <sstream>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "calibration/calibration_policy.hpp"
#include "capture/virtual_rig/rig_renderer.hpp"
#include "capture/virtual_rig/virtual_rig.hpp"
#include "doubles/fake_clock.hpp"
#include "doubles/perfect_calibration.hpp"
#include "doubles/temporary_folder.hpp"
#include "pictures/picture_file.hpp"

namespace telehug {
namespace {

using testing::HasSubstr;

// A camera before whose monitor somebody shows the pages that they are asked for, and lays a finger on their dots.
class ObservantCamera : public FrameSource {
 public:
  ObservantCamera(const VirtualRigSettings& rig, const std::ostringstream& asked, FakeClock& clock)
      : rig_(rig), renderer_(rig), asked_(asked), clock_(clock) {}

  Status open() override { return Done{}; }
  void close() override {}
  [[nodiscard]] bool is_open() const override { return true; }
  ReadOutcome read(Frame& frame, Duration timeout) override {
    const std::string page = asked_for();
    const std::size_t asked_at = asked_.str().rfind(page);
    if (!page.empty() && asked_at != shown_at_) show(page);
    shown_at_ = asked_at;
    if (silent) {
      clock_.advance(timeout);
      return ReadOutcome::timeout;
    }
    clock_.advance(frame_time);
    constexpr int until_the_finger_lies = 15;
    const bool touched = dot_ && somebody && ++frames_ > until_the_finger_lies;
    cv::Mat& picture = known_[{page, touched, frame.sequence % 3}];
    if (picture.empty()) {
      HandPose hand;
      if (touched) hand.finger = {{dot_->x_mm + beside_now_mm_, dot_->y_mm}, 0};
      renderer_.draw(touched ? std::vector<HandPose>{hand} : std::vector<HandPose>{}, frame.sequence, picture);
    }
    frame.bgr = picture;
    ++frame.sequence;
    return ReadOutcome::frame;
  }
  [[nodiscard]] std::string last_error() const override { return ""; }
  [[nodiscard]] std::string name() const override { return "observant camera"; }
  [[nodiscard]] ImageSize size() const override { return rig_.image; }

  bool silent = false;
  bool somebody = true;
  double beside_mm = 0;
  Duration frame_time = 33ms;
  // The page that is not shown when it is first asked for; the finger is laid 8 mm beside where the dot would be.
  std::string black_once = "none";
  std::vector<std::string> pages;  // in the order in which they were shown

 private:
  // The page that was named last.
  [[nodiscard]] std::string asked_for() const {
    const std::string text = asked_.str();
    const std::size_t at = text.rfind("telehug-calibration/");
    return at == std::string::npos ? "" : text.substr(at, text.find(".png", at) + 4 - at);
  }
  void show(const std::string& page) {
    pages.push_back(page);
    frames_ = 0;
    dot_.reset();
    const auto picture = read_picture(page);
    ASSERT_TRUE(picture.ok()) << picture.error().message;
    EXPECT_EQ(picture->cols, rig_.screen.width_px);
    const bool black = page.find(black_once) != std::string::npos && !std::exchange(was_black_, true);
    beside_now_mm_ = black ? 8 : beside_mm;
    renderer_.show(black ? cv::Mat::zeros(picture->size(), CV_8UC3) : *picture);
    known_.clear();
    if (page.find("dot") == std::string::npos) return;
    cv::Mat grey;
    cv::extractChannel(*picture, grey, 0);
    const cv::Moments white = cv::moments(grey);
    dot_ = ScreenPoint{(white.m10 / white.m00 + 0.5) / picture->cols * rig_.screen.width_mm,
                       (white.m01 / white.m00 + 0.5) / picture->rows * rig_.screen.height_mm};
  }

  VirtualRigSettings rig_;
  RigRenderer renderer_;
  const std::ostringstream& asked_;
  FakeClock& clock_;
  std::size_t shown_at_ = 0;  // where it was asked for
  std::optional<ScreenPoint> dot_;
  int frames_ = 0;
  double beside_now_mm_ = 0;
  bool was_black_ = false;
  std::map<std::tuple<std::string, bool, std::uint64_t>, cv::Mat> known_;
};

class CalibratingByHand : public testing::Test {
 protected:
  CalibratingByHand() { std::filesystem::current_path(folder.path()); }
  ~CalibratingByHand() override { std::filesystem::current_path(before); }

  Result<CalibratedRig> calibrate(const std::string& model, bool two_dots = true) {
    HandCalibration wanted{rig.screen, model, {}, two_dots};
    return calibrate_by_hand(camera, wanted, "2026-01-01T00:00:00Z", clock, asked);
  }

  const std::filesystem::path before = std::filesystem::current_path();
  TemporaryFolder folder;
  const VirtualRigSettings rig;
  FakeClock clock;
  std::ostringstream asked;
  ObservantCamera camera{rig, asked, clock};
};

TEST_F(CalibratingByHand, FindsTheCameraAndKeepsTheEmptyRigWithoutAKeyPressed) {
  const auto found = calibrate("default", false);
  ASSERT_TRUE(found.ok()) << found.error().message;
  const auto& solved = std::get<RigCalibration>(found->calibration.solved);
  EXPECT_TRUE(judge_calibration(solved).good());
  EXPECT_EQ(solved.observations.touches.size(), 9U);
  // The triangle's vertex is one more.
  EXPECT_GE(solved.observations.marks.size(), 9U);
  for (const PointObservation& touch : solved.observations.touches) {
    const auto placed = solved.solution.model.camera.screen_point(camera_of(rig).project(touch.screen).value());
    ASSERT_TRUE(placed.has_value());
    EXPECT_NEAR(placed->x_mm, touch.screen.x_mm, 0.2);
    EXPECT_NEAR(placed->y_mm, touch.screen.y_mm, 0.4);
  }
  EXPECT_EQ(found->calibration.camera, "observant camera");
  const SteadyClock steady;
  const double cells = 3.0 * found->empty->cols * found->empty->rows;
  EXPECT_LT(cv::norm(*found->empty, VirtualRig(rig, steady).picture_of_background(), cv::NORM_L1) / cells, 5);
}

TEST_F(CalibratingByHand, AsksForAPageAfterTheOther) {
  ASSERT_TRUE(calibrate("default").ok());
  EXPECT_THAT(camera.pages,
              testing::ElementsAre("telehug-calibration/01-triangle.png", "telehug-calibration/02-black.png",
                                   "telehug-calibration/03-marks.png", "telehug-calibration/04-dot-1.png",
                                   "telehug-calibration/05-dot-2.png"));
}

TEST_F(CalibratingByHand, AsksAgainForATouchThatDoesNotFit) {
  camera.black_once = "dot-2";
  const auto found = calibrate("default");
  ASSERT_TRUE(found.ok()) << found.error().message;
  EXPECT_THAT(
      asked.str(),
      HasSubstr("The touch of dot 2 was not seen, or does not fit the others. Show telehug-calibration/05-dot-2"));
  const auto& solved = std::get<RigCalibration>(found->calibration.solved);
  ASSERT_EQ(solved.observations.touches.size(), 2U);
  EXPECT_FALSE(solved.observations.touches[1].left_out);
}

TEST_F(CalibratingByHand, SaysHowFarTheFingerIsFromItsDot) {
  camera.beside_mm = 60;
  camera.frame_time = 300ms;
  const auto found = calibrate("default");
  ASSERT_FALSE(found.ok());
  EXPECT_THAT(asked.str(), HasSubstr("The finger is beside the dot. (6"));
  EXPECT_THAT(asked.str(), HasSubstr("mm to the right"));
}

TEST_F(CalibratingByHand, SolvesTheThesisModelFromTwoTouches) {
  const auto found = calibrate("thesis");
  ASSERT_TRUE(found.ok()) << found.error().message;
  EXPECT_STREQ(found->calibration.model_name(), "thesis");
  EXPECT_THAT(camera.pages,
              testing::ElementsAre("telehug-calibration/01-triangle.png", "telehug-calibration/02-black.png",
                                   "telehug-calibration/03-dot-1.png", "telehug-calibration/04-dot-2.png"));
  EXPECT_FALSE(std::filesystem::exists("telehug-calibration/03-marks.png"));
}

TEST_F(CalibratingByHand, EndsIfNobodyComes) {
  camera.somebody = false;
  camera.frame_time = 300ms;
  const auto found = calibrate("default");
  ASSERT_FALSE(found.ok());
  EXPECT_THAT(found.error().message, HasSubstr("begin again"));
  EXPECT_THAT(asked.str(), HasSubstr("Lay a finger on the dot"));
}

TEST_F(CalibratingByHand, SaysThatTheCameraIsSilent) {
  camera.silent = true;
  const auto found = calibrate("default");
  ASSERT_FALSE(found.ok());
  EXPECT_THAT(found.error().message, HasSubstr("observant camera delivers no pictures: it is silent"));
}

TEST_F(CalibratingByHand, NeedsTheScreensSize) {
  const auto found = calibrate_by_hand(camera, {}, "", clock, asked);
  ASSERT_FALSE(found.ok());
  EXPECT_THAT(found.error().message, HasSubstr("--width-mm"));
}

}  // namespace
}  // namespace telehug
