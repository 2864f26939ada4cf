// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>

#include "common/clock.hpp"

namespace telehug {

// The touch thread's camera lent to a set-up: two programs can't stream from one webcam, and touches must not go out
// while somebody touches dots. The touch thread never waits.
class CameraHandover {
 public:
  // --- touch thread ---

  // True: the camera must be closed, and stay so.
  [[nodiscard]] bool wanted() const noexcept { return state_ != State::with_touches; }
  // When it is closed and what was touched has ended.
  void let_go() noexcept;

  // --- the set-up's thread ---

  // Waits until the touch thread has let go; false: it has not within that time, and keeps the camera.
  [[nodiscard]] bool take(Duration longest);
  // Idempotent.
  void give_back() noexcept { state_ = State::with_touches; }

 private:
  enum class State { with_touches, wanted, with_setup };
  std::atomic<State> state_{State::with_touches};
};

}  // namespace telehug
