// SPDX-License-Identifier: Apache-2.0
#include "setup_run/camera_handover.hpp"

#include <thread>

namespace telehug {
namespace {

constexpr Duration look_again_after = 2ms;

}  // namespace

void CameraHandover::let_go() noexcept {
  State expected = State::wanted;
  state_.compare_exchange_strong(expected, State::with_setup);
}

bool CameraHandover::take(Duration longest, const std::function<bool()>& waits) {
  state_ = State::wanted;
  const auto deadline = std::chrono::steady_clock::now() + longest;
  while (state_ != State::with_setup) {
    if (std::chrono::steady_clock::now() > deadline || !waits()) {
      give_back();
      return false;
    }
    std::this_thread::sleep_for(look_again_after);
  }
  return true;
}

void CameraHandover::give_back() noexcept {
  touched_here_until_ = clock_.now() + lingers;
  state_ = State::with_touches;
}

}  // namespace telehug
