// SPDX-License-Identifier: Apache-2.0
#include "setup_run/setup_run.hpp"

#include <gmock/gmock.h>

#include <opencv2/core.hpp>

#include "capture/measure_scene.hpp"
#include "doubles/fake_camera_controls.hpp"
#include "doubles/planned_frame_source.hpp"
#include "doubles/temporary_folder.hpp"
#include "setup_run/tuning_with_finger.hpp"

namespace telehug {
namespace {

using testing::HasSubstr;
using Json = nlohmann::json;

// A webcam whose pictures follow its settings: a dark bezel, and a finger across it.
class FilmedFinger final : public FrameSource {
 public:
  FilmedFinger(FakeClock& clock, FakeV4l2& device, const bool& finger)
      : clock_(clock), device_(device), finger_(finger) {}

  Status open() override { return Done{}; }
  void close() override {}
  [[nodiscard]] bool is_open() const override { return true; }
  ReadOutcome read(Frame& frame, Duration) override {
    clock_.advance(33ms);
    const double light = device_.control(V4L2_CID_EXPOSURE_ABSOLUTE) / 100.0;
    frame.bgr = cv::Mat(72, 128, CV_8UC3, cv::Scalar::all(200));
    frame.bgr.rowRange(0, 40).setTo(cv::Scalar(30, 30, 32) * light);
    if (finger_) frame.bgr.colRange(50, 70).setTo(cv::Scalar(60, 75, 105) * light);
    cv::Mat noise(frame.bgr.size(), CV_16SC3);
    random_.fill(noise, cv::RNG::NORMAL, 0, 2);
    cv::add(frame.bgr, noise, frame.bgr, cv::noArray(), CV_8UC3);
    return ReadOutcome::frame;
  }
  [[nodiscard]] std::string last_error() const override { return ""; }
  [[nodiscard]] std::string name() const override { return "filmed finger"; }
  [[nodiscard]] ImageSize size() const override { return {128, 72}; }

 private:
  FakeClock& clock_;
  FakeV4l2& device_;
  const bool& finger_;
  cv::RNG random_{7};
};

class ASetUp : public testing::Test {
 protected:
  ASetUp() {
    device.controls = usual_controls();
    tools.capture.webcam_setup.tuned_file = folder / "camera.toml";
  }

  // With a camera whose pictures the test lays down.
  void begin(const std::string& source = "virtual") {
    auto planned = std::make_unique<PlannedFrameSource>();
    camera = planned.get();
    camera->picture = cv::Mat(720, 1280, CV_8UC3, cv::Scalar::all(90));
    run.emplace(SetupChoice{.camera = source, .screen = {}, .monitor = {}}, std::move(planned), tools, live,
                [this] { return goes_on(); });
  }
  void begin_with_webcam() {
    run.emplace(SetupChoice{.camera = "webcam:/dev/video0", .screen = {}, .monitor = {}}, film(), tools, live,
                [this] { return goes_on(); });
  }
  std::unique_ptr<FrameSource> film() { return std::make_unique<FilmedFinger>(clock, device, finger); }
  void turns(int count) {
    for (int i = 0; i < count; ++i) {
      run->turn();
      clock.advance(33ms);
    }
  }
  void order(const std::string& what) { run->obey({what, 0, chosen}); }
  [[nodiscard]] Json told() const { return run->state(); }

  TemporaryFolder folder;
  FakeClock clock;
  FakeV4l2 device{clock};
  bool finger = false;
  LiveJpeg live{clock};
  std::vector<CameraPreset> reopened;
  SetupTools tools{
      .capture = {},
      .calibration_file = folder / "rig.toml",
      .config = {},
      .open = [this](const std::string&, const CaptureSettings& settings) -> Result<std::unique_ptr<FrameSource>> {
        reopened.push_back(settings.webcam_setup.preset);
        return film();
      },
      .calls = device,
      .clock = clock};
  SetupChoice chosen{.camera = {}, .screen = {380, 300, 1280, 1024}, .monitor = "DP-1", .mode = SetupMode::quick};
  std::function<bool()> goes_on = [] { return true; };
  PlannedFrameSource* camera = nullptr;
  std::optional<SetupRun> run;
};

TEST_F(ASetUp, BeginsByLookingAtTheCameraAndShowsNoPage) {
  begin();
  turns(3);
  EXPECT_TRUE(camera->is_open());
  EXPECT_EQ(told()["step"], "camera");
  EXPECT_EQ(told()["show"]["page"], "none");
  EXPECT_EQ(told()["advice"], "no_border");
  EXPECT_EQ(told()["image"], (Json{{"width_px", 1280}, {"height_px", 720}}));
  EXPECT_EQ(told()["run"]["camera"]["name"], "planned source");
  EXPECT_TRUE(told()["green_band"].is_object());
  EXPECT_FALSE(told()["can"]["confirm"].get<bool>());
}

TEST_F(ASetUp, SaysWhichWayToTurnTheCameraAndWhenTheEdgeIsWhereItShouldBe) {
  begin();
  const auto edge_at = [&](int row) {
    camera->picture.setTo(cv::Scalar::all(200));
    camera->picture.rowRange(0, row).setTo(cv::Scalar::all(40));
    turns(8);
    return told()["advice"].get<std::string>();
  };
  turns(1);
  const double top = told()["green_band"]["top_px"];
  const double bottom = told()["green_band"]["bottom_px"];
  EXPECT_EQ(edge_at(static_cast<int>((top + bottom) / 2)), "good");
  EXPECT_EQ(edge_at(static_cast<int>(top) - 30), "turn_towards_user");
  EXPECT_EQ(edge_at(static_cast<int>(bottom) + 30), "turn_towards_screen");
  EXPECT_EQ(edge_at(static_cast<int>((top + bottom) / 2)), "good") << "also after it had been turned";
}

TEST_F(ASetUp, GoesOnLookingForTheEdgeAsLongAsTheCameraIsLookedAt) {
  begin();
  camera->picture.rowRange(300, 720).setTo(cv::Scalar::all(220));
  for (int second = 0; second < 12; ++second) {
    turns(30);
    EXPECT_EQ(told()["step"], "camera");
    EXPECT_TRUE(told()["border"].is_object()) << second;
  }
  camera->picture.setTo(cv::Scalar::all(90));
  camera->picture.rowRange(450, 720).setTo(cv::Scalar::all(220));
  turns(30);
  EXPECT_NEAR(told()["border"]["points"][4][1].get<double>(), 450, 2) << "the camera was turned";
}

TEST_F(ASetUp, CountsPicturesOfASecond) {
  begin();
  turns(60);
  EXPECT_NEAR(told()["run"]["camera"]["fps"].get<int>(), 30, 1);
}

TEST_F(ASetUp, SaysWhyTheCameraDeliversNothingAndGoesOnWhenItDoes) {
  begin();
  camera->outcome = ReadOutcome::lost;
  camera->error = "there is no webcam; plug it in";
  turns(35);
  EXPECT_EQ(told()["run"]["camera"]["problem"], "there is no webcam; plug it in");
  EXPECT_EQ(told()["advice"], "no_picture");
  EXPECT_FALSE(run->over());
  camera->outcome = ReadOutcome::frame;
  turns(8);
  EXPECT_EQ(told()["run"]["camera"]["problem"], "");
  EXPECT_EQ(told()["advice"], "no_border");
}

TEST_F(ASetUp, ShowsItsPagesWhenTheSizeOfTheScreenIsChosen) {
  begin();
  turns(2);
  order("begin");
  turns(2);
  EXPECT_EQ(told()["step"], "bright");
  EXPECT_EQ(told()["show"]["page"], "triangle");
  EXPECT_EQ(told()["show"]["width_mm"], 380.0);
  EXPECT_EQ(told()["run"]["chosen"], (Json{{"width_mm", 380.0},
                                           {"height_mm", 300.0},
                                           {"width_px", 1280},
                                           {"height_px", 1024},
                                           {"monitor", "DP-1"},
                                           {"mode", "quick"}}));
  order("camera");
  turns(2);
  EXPECT_EQ(told()["step"], "camera");
}

TEST_F(ASetUp, RefusesWhatMakesNoSenseNow) {
  begin();
  turns(2);
  for (const char* what : {"confirm", "look_again", "back", "skip", "repeat", "save"}) {
    order(what);
    EXPECT_EQ(told()["run"]["refusal"], "that can't be done now") << what;
  }
  order("begin");
  EXPECT_EQ(told()["run"]["refusal"], "");
  order("save");
  EXPECT_THAT(told()["run"]["refusal"].get<std::string>(), HasSubstr("not finished"));
  order("tune");
  EXPECT_EQ(told()["run"]["refusal"], "that can't be done now");
  EXPECT_FALSE(std::filesystem::exists(tools.calibration_file));
}

TEST_F(ASetUp, IsOverWhenNobodyComesToItsPages) {
  begin();
  order("begin");
  turns(3);
  clock.advance(290s);
  turns(2);
  EXPECT_EQ(told()["step"], "bright") << "no edge is seen";
  EXPECT_FALSE(run->over());
  clock.advance(301s);
  turns(2);
  EXPECT_TRUE(run->over());
  EXPECT_FALSE(run->saved());
}

TEST_F(ASetUp, ClosesTheCameraAndForgetsItsPictureInTheEnd) {
  begin();
  (void)live.newest();
  turns(2);
  ASSERT_NE(live.newest(), nullptr);
  run.reset();
  EXPECT_EQ(live.newest(), nullptr);
}

// --- the camera's settings ---

TEST_F(ASetUp, HasNothingToTuneInACameraThatIsNone) {
  begin("virtual");
  order("tune");
  EXPECT_THAT(told()["run"]["refusal"].get<std::string>(), HasSubstr("no settings that could be tuned"));
  EXPECT_TRUE(told()["run"]["tune"].is_null());
  EXPECT_FALSE(told()["run"]["camera"]["has_settings"].get<bool>());
}

TEST_F(ASetUp, TunesAWebcamWithAFingerOnTheScreenAndTellsHowFarItIs) {
  std::vector<double> progress;
  device.controls[8].value = V4L2_EXPOSURE_MANUAL;
  begin_with_webcam();
  turns(2);
  order("tune");
  EXPECT_EQ(reopened, std::vector{CameraPreset::fixed}) << "the automatics are off while it is tuned";
  EXPECT_EQ(told()["run"]["tune"]["phase"], "empty");
  order("tune_next");
  EXPECT_EQ(told()["run"]["tune"]["phase"], "finger");
  finger = true;
  order("tune_next");
  goes_on = [&] {
    EXPECT_EQ(told()["run"]["tune"]["phase"], "search");
    progress.push_back(told()["run"]["tune"]["progress"]);
    return true;
  };
  run->turn();
  const Json tune = told()["run"]["tune"];
  EXPECT_EQ(tune["phase"], "done") << tune;
  EXPECT_GT(tune["after"], tune["before"]);
  EXPECT_TRUE(std::ranges::is_sorted(progress));
  EXPECT_GT(progress.size(), 20U);
  EXPECT_EQ(reopened.back(), CameraPreset::tuned) << "and what was found is used from then on";
  EXPECT_TRUE(std::filesystem::exists(folder / "camera.toml"));
  order("tune_end");
  EXPECT_TRUE(told()["run"]["tune"].is_null());
}

TEST_F(ASetUp, EndsTheSearchWhenItIsToldToAndKeepsNothingOfIt) {
  int asked = 0;
  device.controls[8].value = V4L2_EXPOSURE_MANUAL;
  begin_with_webcam();
  order("tune");
  order("tune_next");
  finger = true;
  order("tune_next");
  constexpr int last = settle_frames + 1 + 5;  // five times in the search
  goes_on = [&asked] { return ++asked < last; };
  run->turn();
  EXPECT_EQ(asked, last);
  EXPECT_FALSE(told()["run"]["tune"]["complete"].get<bool>());
  EXPECT_FALSE(std::filesystem::exists(folder / "camera.toml"));
  EXPECT_EQ(reopened.back(), tools.capture.webcam_setup.preset);
}

TEST(AFreshPicture, IsNotWaitedForAnyLongerThanSomebodyWantsIt) {
  PlannedFrameSource camera;
  camera.outcome = ReadOutcome::timeout;
  int asked = 0;
  EXPECT_FALSE(fresh_picture(camera, nullptr, [&asked] { return ++asked < 3; }));
  EXPECT_EQ(asked, 3);
}

TEST_F(ASetUp, SaysWhyTuningIsNoSuccess) {
  begin_with_webcam();
  order("tune");
  order("tune_next");
  order("tune_next");  // no finger
  run->turn();
  EXPECT_EQ(told()["run"]["tune"]["phase"], "failed");
  EXPECT_THAT(told()["run"]["tune"]["problem"].get<std::string>(), HasSubstr("lay one finger"));
}

TEST_F(ASetUp, PutsTheCameraBackWhenTuningIsBrokenOffBeforeTheSearch) {
  begin_with_webcam();
  order("tune");
  order("tune_end");
  EXPECT_EQ(reopened, (std::vector{CameraPreset::fixed, tools.capture.webcam_setup.preset}));
  EXPECT_TRUE(told()["run"]["tune"].is_null());
}

}  // namespace
}  // namespace telehug
