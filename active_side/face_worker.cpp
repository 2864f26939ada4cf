// SPDX-License-Identifier: Apache-2.0
#include "face_worker.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

namespace telehug {
namespace {

// Where nobody has been seen for a while nobody is likely to be in the next moment.
constexpr Duration idle_after = 10s;
constexpr Duration idle_period = 500ms;

}  // namespace

Duration look_interval(Duration period, Duration without_face) {
  return without_face > idle_after ? std::max(period, idle_period) : period;
}

FaceWorker::FaceWorker(std::unique_ptr<ScreenGrabber> grabber, std::unique_ptr<FaceFinder> finder,
                       const BodyMapStepConfig& config, double rate_hz, const Clock& clock, MetricsRegistry& metrics)
    : grabber_(std::move(grabber)),
      finder_(std::move(finder)),
      step_(*grabber_, *finder_, config),
      live_(grabber_->is_live()),
      pins_window_(grabber_->pins_window()),
      period_(std::chrono::duration_cast<Duration>(std::chrono::duration<double>(1 / rate_hz))),
      clock_(clock),
      latency_(metrics.latency("face")),
      last_face_(clock.now()) {
  state_.screen = grabber_->name();
  state_.finder = finder_->name();
  thread_ = std::thread([this] { work(); });
}

FaceWorker::~FaceWorker() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

void FaceWorker::want(bool wanted) {
  if (wanted == wanted_) return;
  {
    const std::lock_guard lock(mutex_);
    wanted_ = wanted;
    has_looked_ = false;
  }
  changed_.notify_one();
}

void FaceWorker::update(BodyMap& map) {
  if (auto newer = newest_.try_take()) map = *newer;
}

ScreenView FaceWorker::view() const noexcept {
  const Front front = front_;
  return {live_, pins_window_, front == Front::unknown ? std::nullopt : std::optional(front == Front::front)};
}

void FaceWorker::order(FaceOrder order) {
  {
    const std::lock_guard lock(mutex_);
    if (orders_.size() < 16) orders_.push_back(order);  // more than anybody can press before the next look
  }
  changed_.notify_one();
}

void FaceWorker::leave_out(const std::vector<cv::Rect>& areas_px) {
  const std::lock_guard lock(mutex_);
  left_out_px_ = areas_px;
}

FaceState FaceWorker::state() const {
  const std::lock_guard lock(mutex_);
  return state_;
}

void FaceWorker::work() {
  std::unique_lock lock(mutex_);
  while (!ending_) {
    const bool wanted = wanted_;
    const std::vector<FaceOrder> orders = std::exchange(orders_, {});
    auto left_out_px = std::exchange(left_out_px_, std::nullopt);
    lock.unlock();
    const Timestamp started = clock_.now();
    try {
      if (left_out_px) grabber_->leave_out(*left_out_px);
      do_round(wanted, orders);
    } catch (const std::exception& fault) {  // of a library, on a picture that it can't bear
      fail(fault);
    }
    lock.lock();
    // A look that belongs to an earlier wish says nothing about this one.
    if (wanted && wanted_) has_looked_ = true;
    const auto next = [this, wanted] { return ending_ || wanted_ != wanted || !orders_.empty(); };
    if (wanted) {
      changed_.wait_until(lock, started + look_interval(period_, started - last_face_), next);
    } else {
      changed_.wait(lock, next);
    }
  }
}

void FaceWorker::do_round(bool wanted, const std::vector<FaceOrder>& orders) {
  obey(orders);
  if (wanted) {
    look();
  } else {
    rest();
  }
}

void FaceWorker::fail(const std::exception& fault) {
  newest_.put(BodyMap{});
  front_ = Front::unknown;
  const std::lock_guard lock(mutex_);
  state_.map = {};
  state_.problem = fmt::format("the picture of the screen can't be searched: {}", fault.what());
}

void FaceWorker::obey(const std::vector<FaceOrder>& orders) {
  for (const FaceOrder order : orders) {
    switch (order) {
      case FaceOrder::next:
        step_.follower().next();
        break;
      case FaceOrder::pin:
        step_.follower().pin();
        break;
      case FaceOrder::unpin:
        step_.follower().unpin();
        break;
    }
  }
}

void FaceWorker::look() {
  const Timestamp started = clock_.now();
  const Status opened = grabber_->open();
  const BodyMap map = step_.run();
  std::string problem = opened ? step_.problem() : opened.error().message;
  const auto in_front = step_.in_front();
  front_ = !in_front ? Front::unknown : *in_front ? Front::front : Front::covered;
  newest_.put(map);
  const RemoteFaceFollower& follower = step_.follower();
  if (problem.empty() || follower.why_nobody() != NobodyFollowed::no_face) last_face_ = started;
  latency_.record(clock_.now() - started);
  const std::lock_guard lock(mutex_);
  const auto scale = step_.scale();
  state_ = {.screen = grabber_->name(),
            .open = grabber_->is_open(),
            .problem = std::move(problem),
            .finder = finder_->name(),
            .map = map,
            .scale = scale ? std::optional(*scale) : std::nullopt,
            .remark = grabber_->remark(),
            .others = follower.others(),
            .pinned = follower.pinned()};
}

void FaceWorker::rest() {
  newest_.put(BodyMap{});
  front_ = Front::unknown;
  step_.rest();
  grabber_->close();
  last_face_ = clock_.now();
  const std::lock_guard lock(mutex_);
  state_ = {};
  state_.screen = grabber_->name();
  state_.finder = finder_->name();
}

}  // namespace telehug
