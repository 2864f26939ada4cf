// SPDX-License-Identifier: Apache-2.0
//
// What the emergency stop button means: a state machine on explicit time.
//
//   pressed (or its line lost, or pressed at the start)  -> everything stops, and nothing resumes while it is so
//   let go                                               -> still stopped
//   pressed again while stopped, held 5 s, let go within the next 10 s  -> resumed
//
// The press that stops never resumes, however long it lasts: who clings to the button in fear wants no motor to start.
// Nor does a press that never ends, which may be a broken cable or a button that latches.
#pragma once

#include <optional>

#include "gpio/debouncer.hpp"

namespace telehug {

class EmergencyStop {
 public:
  // A contact that has been bouncing for so long counts as pressed: a cable may be broken and its end swing with the
  // mains.
  static constexpr Duration longest_bounce = 30ms;
  static constexpr Duration to_let_go = 10s;

  struct Settings {
    Duration debounce = 10ms;      // below longest_bounce
    Duration hold_to_resume = 5s;  // 0: no press resumes
  };
  struct Orders {
    bool stop = false;
    bool resume = false;
  };

  // active: the button's level at the start.
  EmergencyStop(const Settings& settings, bool active) noexcept;

  // The button's level from `time` on.
  void level(bool active, Timestamp time) noexcept;
  // The line can't be read any more; that is for good.
  void lose() noexcept;

  // What is to be done, once each. stopped: is everything stopped now, for whatever reason? Call it at least when
  // something changes and when due() has come.
  [[nodiscard]] Orders orders(Timestamp now, bool stopped) noexcept;

  // Nothing may resume while this is so.
  [[nodiscard]] bool pressed() const noexcept { return lost_ || pressed_; }
  [[nodiscard]] bool lost() const noexcept { return lost_; }
  [[nodiscard]] std::optional<Timestamp> due() const noexcept;

 private:
  void follow(Timestamp now) noexcept;

  Settings settings_;
  Debouncer contact_;
  bool stopped_ = false;
  bool pressed_;
  bool lost_ = false;
  bool may_resume_ = false;  // this press
  Timestamp pressed_since_{};
  Orders orders_;
};

}  // namespace telehug
