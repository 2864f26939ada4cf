// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <functional>

#include "common/clock.hpp"

namespace telehug {

// The touch thread's camera lent to a set-up: two programs can't stream from one webcam, and touches must not go out
// while somebody touches dots. The touch thread never waits.
class CameraHandover {
 public:
  // A finger that still lies on a dot when a set-up ends has this long to be seen, so that it is held back until it is
  // lifted.
  static constexpr Duration lingers = 2s;

  // `clock` outlives it.
  explicit CameraHandover(const Clock& clock) : clock_(clock) {}

  // --- any thread ---

  // A set-up has the camera or had it a moment ago: what touches the screen is meant for it and for nobody else.
  [[nodiscard]] bool touched_here() const noexcept { return wanted() || clock_.now() < touched_here_until_.load(); }

  // --- touch thread ---

  // True: the camera must be closed, and stay so.
  [[nodiscard]] bool wanted() const noexcept { return state_ != State::with_touches; }
  // When it is closed and what was touched has ended.
  void let_go() noexcept;

  // --- the set-up's thread ---

  // Waits until the touch thread has let go; false: it has not within that time, or as long as `waits`, and keeps the
  // camera.
  [[nodiscard]] bool take(
      Duration longest, const std::function<bool()>& waits = [] { return true; });
  // Idempotent.
  void give_back() noexcept;

 private:
  enum class State { with_touches, wanted, with_setup };
  const Clock& clock_;
  std::atomic<State> state_{State::with_touches};
  std::atomic<Timestamp> touched_here_until_{Timestamp{}};
};

}  // namespace telehug
