// SPDX-License-Identifier: Apache-2.0
#include "local_touch/local_touch.hpp"

namespace telehug {
namespace {
constexpr Duration longest_wait = 100ms;
}

LocalTouch::LocalTouch(std::vector<std::unique_ptr<LocalTouchOutput>> outputs, const Clock& clock)
    : clock_(clock), on_(!outputs.empty()), outputs_(std::move(outputs)), states_(outputs_.states()) {
  if (on_) thread_ = std::thread([this] { run(); });
}

LocalTouch::~LocalTouch() {
  ending_ = true;
  if (thread_.joinable()) thread_.join();
  outputs_.close();
}

void LocalTouch::put(const ContactStates& contacts, const ScreenSize& screen, Timestamp time) {
  if (on_) newest_.put({contacts, screen, time});
}

std::vector<LocalTouchState> LocalTouch::states() const {
  const std::lock_guard lock(mutex_);
  return states_;
}

void LocalTouch::run() {
  while (!ending_) {
    const auto frame = newest_.wait_and_take(clock_.now() + longest_wait);
    outputs_.serve(frame ? &*frame : nullptr, clock_.now());
    auto states = outputs_.states();
    const std::lock_guard lock(mutex_);
    states_ = std::move(states);
  }
}

}  // namespace telehug
