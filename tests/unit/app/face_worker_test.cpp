// SPDX-License-Identifier: Apache-2.0
#include "face_worker.hpp"

#include <gtest/gtest.h>

#include <condition_variable>
#include <mutex>

#include "doubles/planned_face_finder.hpp"
#include "doubles/planned_screen_grabber.hpp"

namespace telehug {
namespace {

const BodyMapStepConfig in_px{.screen = {}, .rules = {}, .tracker = {}, .mirrored = false};

// Tells when it was asked, so that a test need not sleep.
class WatchedGrabber final : public ScreenGrabber {
 public:
  WatchedGrabber() {
    picture_.bgr = cv::Mat(400, 400, CV_8UC3, cv::Scalar::all(0));
    picture_.monitor = {.width_px = 400, .height_px = 400};
  }
  Status open() override {
    const std::lock_guard lock(mutex);
    open_ = true;
    return Done{};
  }
  void close() override {
    const std::lock_guard lock(mutex);
    open_ = false;
    ++closings;
    changed.notify_all();
  }
  [[nodiscard]] bool is_open() const override { return open_; }
  GrabOutcome grab(ScreenPicture& picture) override {
    const std::lock_guard lock(mutex);
    if (moving) picture_.bgr.setTo(cv::Scalar::all(grabs * 40 % 256));
    picture = picture_;
    picture.time = std::chrono::steady_clock::now();
    picture.in_front = in_front;
    ++grabs;
    changed.notify_all();
    return GrabOutcome::changed;
  }
  void leave_out(const std::vector<cv::Rect>& areas_px) override {
    const std::lock_guard lock(mutex);
    left_out_px = areas_px;
    changed.notify_all();
  }
  [[nodiscard]] bool is_live() const override { return true; }
  [[nodiscard]] std::string name() const override { return "watched"; }
  [[nodiscard]] std::string last_error() const override { return ""; }

  template <typename Condition>
  bool becomes(Condition condition) {
    std::unique_lock lock(mutex);
    return changed.wait_for(lock, 20s, condition);
  }

  std::mutex mutex;
  std::condition_variable changed;
  bool moving = true;
  std::optional<bool> in_front;
  std::vector<cv::Rect> left_out_px;
  int grabs = 0;
  int closings = 0;

 private:
  ScreenPicture picture_;
  bool open_ = false;
};

class FaceWorkerTest : public testing::Test {
 protected:
  FaceWorkerTest() {
    auto owned = std::make_unique<WatchedGrabber>();
    grabber = owned.get();
    FoundFaces faces{{.box = {100, 50, 72, 100}, .score = 0.9}, {.box = {250, 50, 65, 90}, .score = 0.9}};
    worker = std::make_unique<FaceWorker>(std::move(owned), std::make_unique<PlannedFaceFinder>(faces), in_px, 100,
                                          clock, metrics);
  }
  void look_twice() {
    int before = 0;
    {
      const std::lock_guard lock(grabber->mutex);
      before = grabber->grabs;
    }
    ASSERT_TRUE(grabber->becomes([&] { return grabber->grabs >= before + 2; }));
  }
  // Until then the state of a look that has been seen may not be told yet.
  template <typename Condition>
  bool state_becomes(Condition condition) {
    for (int looks = 0; looks < 1000 && !condition(worker->state()); ++looks)
      look_twice();
    return condition(worker->state());
  }

  SteadyClock clock;
  MetricsRegistry metrics;
  WatchedGrabber* grabber = nullptr;
  std::unique_ptr<FaceWorker> worker;
};

TEST(LookInterval, IsHalfASecondWhereNobodyWasSeenForTenSeconds) {
  EXPECT_EQ(look_interval(125ms, 10s), 125ms);
  EXPECT_EQ(look_interval(125ms, 10s + 1ns), 500ms);
  EXPECT_EQ(look_interval(2s, 11s), 2s);
}

TEST_F(FaceWorkerTest, LooksOnlyWhileSomebodyWantsIt) {
  EXPECT_TRUE(grabber->becomes([&] { return grabber->closings == 1; })) << "it begins resting";
  EXPECT_EQ(grabber->grabs, 0);
  EXPECT_FALSE(worker->has_looked());
  worker->want(true);
  look_twice();
  EXPECT_TRUE(worker->has_looked());
  EXPECT_TRUE(state_becomes([](const FaceState& state) { return state.map.version != 0 && state.others == 1; }));
  worker->want(false);
  EXPECT_FALSE(worker->has_looked());
  EXPECT_TRUE(grabber->becomes([&] { return grabber->closings == 2; }));
}

TEST_F(FaceWorkerTest, KnowsNobodyAnyMoreAfterARest) {
  worker->want(true);
  ASSERT_TRUE(state_becomes([](const FaceState& state) { return state.map.version != 0; }));
  worker->want(false);
  ASSERT_TRUE(grabber->becomes([&] { return !grabber->is_open(); }));
  {
    const std::lock_guard lock(grabber->mutex);
    grabber->moving = false;
  }
  worker->want(true);
  for (int i = 0; i < 5; ++i)
    look_twice();
  EXPECT_EQ(worker->state().map.version, 0U) << "a still picture where somebody was";
}

TEST_F(FaceWorkerTest, TellsWhetherThePinnedWindowIsInFront) {
  EXPECT_FALSE(worker->view().in_front);
  {
    const std::lock_guard lock(grabber->mutex);
    grabber->in_front = true;
  }
  worker->want(true);
  look_twice();
  EXPECT_EQ(worker->view().in_front, true);
  {
    const std::lock_guard lock(grabber->mutex);
    grabber->in_front = false;
  }
  look_twice();
  EXPECT_EQ(worker->view().in_front, false);
  worker->want(false);
  ASSERT_TRUE(grabber->becomes([&] { return !grabber->is_open(); }));
  EXPECT_FALSE(worker->view().in_front);
}

TEST_F(FaceWorkerTest, ObeysBeforeTheNextLook) {
  worker->want(true);
  ASSERT_TRUE(state_becomes([](const FaceState& state) { return state.map.version != 0 && state.others == 1; }));
  const auto followed_x = [](const FaceState& state) { return state.map.face.x_mm; };
  EXPECT_DOUBLE_EQ(followed_x(worker->state()), 100);
  worker->order(FaceOrder::next);
  EXPECT_TRUE(state_becomes([&](const FaceState& state) { return followed_x(state) == 250; }));
  worker->order(FaceOrder::pin);
  EXPECT_TRUE(state_becomes([](const FaceState& state) { return state.pinned; }));
  worker->order(FaceOrder::unpin);
  EXPECT_TRUE(state_becomes([](const FaceState& state) { return !state.pinned; }));
}

TEST_F(FaceWorkerTest, TellsTheGrabberWhatTelehugDrawsItself) {
  worker->want(true);
  worker->leave_out({cv::Rect(1, 2, 3, 4)});
  EXPECT_TRUE(grabber->becomes([&] { return grabber->left_out_px == std::vector{cv::Rect(1, 2, 3, 4)}; }));
}

}  // namespace
}  // namespace telehug
