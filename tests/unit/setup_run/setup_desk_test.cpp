// SPDX-License-Identifier: Apache-2.0
#include "setup_run/setup_desk.hpp"

#include <gmock/gmock.h>

#include <future>
#include <mutex>

#include "doubles/temporary_folder.hpp"
#include "doubles/test_pictures.hpp"

namespace telehug {
namespace {

using testing::HasSubstr;
using Json = nlohmann::json;

// A clock that the test moves while other threads read it.
class SharedClock final : public Clock {
 public:
  [[nodiscard]] Timestamp now() const noexcept override { return from_ns(ns_); }
  void advance(Duration by) { ns_ += std::chrono::nanoseconds(by).count(); }

 private:
  std::atomic<std::int64_t> ns_ = 1'000'000'000;
};

struct CameraState {
  std::atomic<int> open = 0;
  std::atomic<bool> lent = false;  // by the touch thread, whenever it was open
  std::atomic<bool> faulty = false;
  std::atomic<bool> hangs = false;
};

class CountedCamera final : public FrameSource {
 public:
  CountedCamera(CameraState& state, const CameraHandover& handover) : state_(state), handover_(handover) {}
  ~CountedCamera() override { close(); }
  CountedCamera(const CountedCamera&) = delete;
  CountedCamera& operator=(const CountedCamera&) = delete;
  Status open() override {
    while (state_.hangs)
      std::this_thread::sleep_for(1ms);
    if (!std::exchange(open_, true)) ++state_.open;
    state_.lent = handover_.wanted();
    return Done{};
  }
  void close() override {
    if (std::exchange(open_, false)) --state_.open;
  }
  [[nodiscard]] bool is_open() const override { return open_; }
  ReadOutcome read(Frame& frame, Duration) override {
    if (state_.faulty) throw std::runtime_error("the camera is on fire");
    std::this_thread::sleep_for(1ms);
    frame.bgr = picture_;
    return ReadOutcome::frame;
  }
  [[nodiscard]] std::string last_error() const override { return ""; }
  [[nodiscard]] std::string name() const override { return "counted"; }
  [[nodiscard]] ImageSize size() const override { return {160, 120}; }

 private:
  CameraState& state_;
  const CameraHandover& handover_;
  bool open_ = false;
  cv::Mat picture_ = sloping_picture(160, 120);
};

class TheSetUpDesk : public testing::Test {
 protected:
  TheSetUpDesk() {
    control.start();
    touch_thread = std::jthread([this](const std::stop_token& stop) {
      while (!stop.stop_requested()) {
        if (desk.camera().wanted() && lets_go) desk.camera().let_go();
        std::this_thread::sleep_for(1ms);
      }
    });
  }
  ~TheSetUpDesk() override { touch_thread = {}; }

  Json ask(Json request) {
    request["command"] = "setup";
    std::promise<Json> answer;
    control.ask(std::move(request), [&answer](Json said) { answer.set_value(std::move(said)); });
    return answer.get_future().get();
  }
  // What the pages were told last, once it is `wanted`.
  Json told(const std::function<bool(const Json&)>& wanted) {
    const auto deadline = std::chrono::steady_clock::now() + 20s;
    while (std::chrono::steady_clock::now() < deadline) {
      if (auto news = desk.news()) newest = *std::move(news);
      if (wanted(newest)) return newest;
      std::this_thread::sleep_for(1ms);
    }
    ADD_FAILURE() << "never told; the newest is " << newest;
    return newest;
  }
  Json told_stage(const std::string& stage) {
    return told([&](const Json& news) { return news["stage"] == stage; });
  }

  TemporaryFolder folder;
  SharedClock clock;
  CameraState camera;
  std::atomic<bool> lets_go = true;
  std::atomic<bool> stopped = false;
  ControlServer control{ControlServerOptions{.socket = folder / "control.sock", .group = {}}};
  SetupDeskSettings settings() {
    return {
        .config = {},
        .tools = {.capture = {},
                  .calibration_file = folder / "rig.toml",
                  .config = {},
                  .open = [this](const std::string&, const CaptureSettings&) -> Result<std::unique_ptr<FrameSource>> {
                    return std::unique_ptr<FrameSource>(std::make_unique<CountedCamera>(camera, desk.camera()));
                  },
                  .calls = kernel_v4l2_calls(),
                  .clock = clock},
        .cameras =
            [] {
              return std::vector<OfferedCamera>{{"virtual", "a camera"}, {"webcam:/dev/x", "another"}};
            },
        .monitors = [] { return std::vector<SizedMonitor>(); },
        .why_stopped = [this] { return std::string(stopped ? "it is stopped: resume" : ""); }};
  }
  SetupDesk desk{settings(), control};
  Json newest;
  std::jthread touch_thread;
};

TEST_F(TheSetUpDesk, SaysWhatThereIsToChooseFrom) {
  const Json offers = ask({{"order", "list"}});
  EXPECT_EQ(offers["cameras"].size(), 2U);
  EXPECT_TRUE(offers["monitors"].empty());
  EXPECT_EQ(offers["chosen"]["camera"], "virtual");
  EXPECT_EQ(told_stage("idle")["stage"], "idle");
}

TEST_F(TheSetUpDesk, OpensTheCameraOnlyWhenTheTouchThreadHasLetGo) {
  lets_go = false;
  EXPECT_FALSE(ask({{"order", "start"}}).contains("error"));
  told_stage("waiting");
  EXPECT_EQ(camera.open, 0);
  lets_go = true;
  const Json running = told_stage("running");
  EXPECT_EQ(running["step"], "camera");
  EXPECT_EQ(camera.open, 1);
  EXPECT_TRUE(camera.lent);
  EXPECT_TRUE(desk.camera().wanted());
}

TEST_F(TheSetUpDesk, GivesTheCameraBackWhenItIsBrokenOff) {
  ask({{"order", "start"}});
  told_stage("running");
  EXPECT_FALSE(ask({{"order", "cancel"}}).contains("error"));
  EXPECT_EQ(told_stage("ended")["why"], "cancelled");
  EXPECT_EQ(camera.open, 0);
  EXPECT_FALSE(desk.camera().wanted());
  EXPECT_FALSE(desk.take_saved());
  ask({{"order", "cancel"}});
  told_stage("idle");
}

TEST_F(TheSetUpDesk, EndsWhenSomebodyStopsAndBeginsNoneBeforeTheyResume) {
  ask({{"order", "start"}});
  told_stage("running");
  stopped = true;
  EXPECT_EQ(told_stage("ended")["why"], "stopped");
  EXPECT_EQ(camera.open, 0);
  EXPECT_FALSE(desk.camera().wanted());
  EXPECT_EQ(ask({{"order", "start"}}).value("error", ""), "it is stopped: resume");
  stopped = false;
  EXPECT_EQ(ask({{"order", "start"}}).value("error", ""), "");
  told_stage("running");
}

TEST_F(TheSetUpDesk, SaysThatTheCameraHangsAndEndsWhenItDoesNotAnyMore) {
  camera.hangs = true;
  ask({{"order", "start"}});
  told_stage("waiting");
  clock.advance(10s);
  desk.followed();
  EXPECT_FALSE(desk.camera_hangs());
  clock.advance(1ms);
  EXPECT_TRUE(desk.camera_hangs());
  told([](const Json& news) { return news["stage"] == "waiting" && news.value("hangs", false); });
  EXPECT_THAT(ask({{"order", "start"}}).value("error", ""), HasSubstr("unplug it"));
  ask({{"order", "cancel"}});
  camera.hangs = false;
  EXPECT_EQ(told_stage("ended")["why"], "cancelled");
  EXPECT_FALSE(desk.camera_hangs());
}

TEST_F(TheSetUpDesk, EndsAtOnceWhileTheTouchThreadStillHasTheCamera) {
  lets_go = false;
  ask({{"order", "start"}});
  told_stage("waiting");
  ask({{"order", "cancel"}});
  EXPECT_EQ(told_stage("ended")["why"], "cancelled");
  EXPECT_FALSE(desk.camera().wanted());
}

TEST_F(TheSetUpDesk, EndsWhenNoPageHasFollowedForTenSeconds) {
  ask({{"order", "start"}});
  told_stage("running");
  for (int second = 0; second < 15; ++second) {
    clock.advance(1s);
    desk.followed();
  }
  told([](const Json& news) { return news["stage"] == "running"; });
  EXPECT_EQ(camera.open, 1);
  clock.advance(10'001ms);
  EXPECT_EQ(told_stage("ended")["why"], "unfollowed");
  EXPECT_EQ(camera.open, 0);
}

TEST_F(TheSetUpDesk, EndsThoughAPageIsOpenWhenNobodyGoesOnForAQuarterOfAnHour) {
  const auto minutes_pass = [this](int minutes) {
    for (int i = 0; i < 12 * minutes; ++i) {
      clock.advance(5s);
      desk.followed();
    }
  };
  ask({{"order", "start"}});
  told_stage("running");
  minutes_pass(14);
  EXPECT_FALSE(ask({{"order", "camera"}}).contains("error")) << "an order: somebody is there";
  minutes_pass(14);
  EXPECT_FALSE(ask({{"order", "camera"}}).contains("error"));
  EXPECT_EQ(camera.open, 1);
  minutes_pass(16);
  EXPECT_EQ(told_stage("ended")["why"], "idle");
  EXPECT_EQ(camera.open, 0);
  EXPECT_FALSE(desk.camera().wanted());
}

TEST_F(TheSetUpDesk, TellsASecondPageThatOneRunsAlready) {
  ask({{"order", "start"}});
  told_stage("running");
  EXPECT_THAT(ask({{"order", "start"}})["error"].get<std::string>(), HasSubstr("runs already"));
  EXPECT_EQ(camera.open, 1);
}

TEST_F(TheSetUpDesk, BeginsAnewAfterOneHasEnded) {
  for (int time = 0; time < 3; ++time) {
    ASSERT_EQ(ask({{"order", "start"}}).value("error", ""), "");
    told_stage("running");
    ask({{"order", "cancel"}});
    told_stage("ended");
  }
}

TEST_F(TheSetUpDesk, RefusesOrdersThatMakeNoSense) {
  const auto refused = [this](const Json& request) { return ask(request).value("error", ""); };
  EXPECT_THAT(refused({{"order", "dance"}}), HasSubstr("is one of list, start, cancel, begin"));
  EXPECT_THAT(refused({{"order", 7}}), HasSubstr("is one of"));
  EXPECT_THAT(refused({{"order", "confirm"}}), HasSubstr("no set-up runs"));
  EXPECT_THAT(refused({{"order", "start"}, {"camera", "replay:/etc"}}), HasSubstr("not there any more"));
  EXPECT_THAT(refused({{"order", "start"}, {"camera", 3}}), HasSubstr("not there any more"));
  EXPECT_THAT(refused({{"order", "start"}, {"width_mm", 1}}), HasSubstr("100 to 3000 mm"));
  EXPECT_FALSE(desk.camera().wanted());
  ask({{"order", "start"}});
  told_stage("running");
  EXPECT_THAT(refused({{"order", "begin"}}), HasSubstr("how large is the visible screen?"));
  EXPECT_THAT(refused({{"order", "repeat"}}), HasSubstr("number of a dot"));
  EXPECT_THAT(refused({{"order", "repeat"}, {"dot", -1}}), HasSubstr("number of a dot"));
}

TEST_F(TheSetUpDesk, MakesNoCalibrationThatTheConfigurationCantUse) {
  SetupDeskSettings thesis = settings();
  thesis.config.touch.model = "thesis";
  ControlServer other(ControlServerOptions{.socket = folder / "other.sock", .group = {}});
  SetupDesk strict(std::move(thesis), other);
  other.start();
  const auto say = [&other](const Json& request) {
    std::promise<Json> answer;
    other.ask(request, [&answer](Json said) { answer.set_value(std::move(said)); });
    return answer.get_future().get();
  };
  EXPECT_EQ(say({{"command", "setup"}, {"order", "list"}})["chosen"]["mode"], "thesis");
  say({{"command", "setup"}, {"order", "start"}});
  Json begin{{"command", "setup"}, {"order", "begin"}, {"width_mm", 380}, {"height_mm", 300}, {"mode", "full"}};
  EXPECT_THAT(say(begin).value("error", ""), HasSubstr("[touch] model"));
  begin["mode"] = "thesis";
  EXPECT_EQ(say(begin).value("error", ""), "");
  strict.camera().let_go();
}

TEST_F(TheSetUpDesk, PassesOrdersOn) {
  ask({{"order", "start"}});
  told_stage("running");
  ask({{"order", "begin"}, {"width_mm", 380}, {"height_mm", 300}, {"mode", "quick"}});
  const Json begun = told([](const Json& news) { return news["step"] == "bright"; });
  EXPECT_EQ(begun["run"]["chosen"]["mode"], "quick");
  ask({{"order", "camera"}});
  told([](const Json& news) { return news["step"] == "camera"; });
}

TEST_F(TheSetUpDesk, ShowsWhatTheCameraSeesWhileItRuns) {
  EXPECT_EQ(desk.picture(), nullptr);
  ask({{"order", "start"}});
  told([this](const Json&) { return desk.picture() != nullptr; });
  ask({{"order", "cancel"}});
  told_stage("ended");
  EXPECT_EQ(desk.picture(), nullptr);
}

TEST_F(TheSetUpDesk, SurvivesACameraThatFailsAndSaysSo) {
  ask({{"order", "start"}});
  told_stage("running");
  camera.faulty = true;
  const Json ended = told_stage("ended");
  EXPECT_EQ(ended["why"], "failed");
  EXPECT_EQ(ended["problem"], "the camera is on fire");
  EXPECT_EQ(camera.open, 0);
  EXPECT_FALSE(desk.camera().wanted());
}

TEST(TheHandoverOfTheCamera, KeepsItWithTheTouchesIfTheyDontLetGo) {
  const SharedClock clock;
  CameraHandover handover(clock);
  EXPECT_FALSE(handover.wanted());
  EXPECT_FALSE(handover.take(20ms));
  EXPECT_FALSE(handover.wanted());
}

TEST(TheHandoverOfTheCamera, IsNotMadeByLettingGoOfWhatNobodyWants) {
  const SharedClock clock;
  CameraHandover handover(clock);
  handover.let_go();
  EXPECT_FALSE(handover.wanted());
  EXPECT_FALSE(handover.take(20ms)) << "it is only let go of when it was wanted before";
}

TEST(TheHandoverOfTheCamera, LeavesTouchesToTheSetUpForAMomentLonger) {
  SharedClock clock;
  CameraHandover handover(clock);
  EXPECT_FALSE(handover.touched_here());
  std::jthread touch_thread([&](const std::stop_token& stop) {
    while (!stop.stop_requested())
      handover.let_go();
  });
  ASSERT_TRUE(handover.take(10s));
  clock.advance(1h);
  EXPECT_TRUE(handover.touched_here());
  handover.give_back();
  EXPECT_FALSE(handover.wanted());
  clock.advance(1'999ms);
  EXPECT_TRUE(handover.touched_here()) << "a finger that lies there is not for the wearer";
  clock.advance(1ms);
  EXPECT_FALSE(handover.touched_here());
}

}  // namespace
}  // namespace telehug
