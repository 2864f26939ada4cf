// SPDX-License-Identifier: Apache-2.0
#include "face_worker.hpp"

#include <exception>
#include <utility>

namespace telehug {

FaceWorker::FaceWorker(std::unique_ptr<ScreenGrabber> grabber, std::unique_ptr<FaceFinder> finder,
                       const BodyMapStepConfig& config, double rate_hz, const Clock& clock, MetricsRegistry& metrics)
    : grabber_(std::move(grabber)),
      finder_(std::move(finder)),
      step_(*grabber_, *finder_, config),
      period_(std::chrono::duration_cast<Duration>(std::chrono::duration<double>(1 / rate_hz))),
      clock_(clock),
      latency_(metrics.latency("face")) {
  state_.screen = grabber_->name();
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

FaceState FaceWorker::state() const {
  const std::lock_guard lock(mutex_);
  return state_;
}

void FaceWorker::work() {
  std::unique_lock lock(mutex_);
  while (!ending_) {
    const bool wanted = wanted_;
    lock.unlock();
    const Timestamp started = clock_.now();
    if (wanted) {
      look();
    } else {
      rest();
    }
    lock.lock();
    // A look that belongs to an earlier wish says nothing about this one.
    if (wanted && wanted_) has_looked_ = true;
    const auto next = [this, wanted] { return ending_ || wanted_ != wanted; };
    if (wanted) {
      changed_.wait_until(lock, started + period_, next);
    } else {
      changed_.wait(lock, next);
    }
  }
}

void FaceWorker::look() {
  const Timestamp started = clock_.now();
  std::string problem;
  BodyMap map;
  try {
    if (const Status opened = grabber_->open(); !opened) problem = opened.error().message;
    map = step_.run();
    if (problem.empty()) problem = step_.problem();
  } catch (const std::exception& fault) {  // of a library, on a picture that it can't bear
    problem = std::string("the picture of the screen can't be searched: ") + fault.what();
  }
  newest_.put(map);
  latency_.record(clock_.now() - started);
  const std::lock_guard lock(mutex_);
  state_ = {grabber_->name(), grabber_->is_open(), std::move(problem), map};
}

void FaceWorker::rest() {
  grabber_->close();
  newest_.put(BodyMap{});
  const std::lock_guard lock(mutex_);
  state_ = {grabber_->name(), false, "", BodyMap{}};
}

}  // namespace telehug
