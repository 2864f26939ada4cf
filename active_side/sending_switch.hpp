// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "service/control_server.hpp"

namespace telehug {

enum class SendingMode {
  automatic,  // while the pinned window is in front; of a live screen without a pinned window nothing
  on,
  off,
};

// What is known of the screen.
struct ScreenView {
  bool live = false;             // it shows what happens now, not a file
  bool pins_window = false;      // one window is to be looked at
  std::optional<bool> in_front;  // is that in front? none: no window is pinned, or it is not seen
};

enum class SendingVerdict {
  sends,
  switched_off,
  used_here,     // a page of this PC uses the fingers, such as one to draw on
  not_seen,      // the pinned window is not there, or not looked at
  covered,       // another window covers it
  never_pinned,  // no window is pinned, so that only `on` sends
};

// Do touches on the screen go out? So that cleaning it or using another program touches nobody.
[[nodiscard]] SendingVerdict judge_sending(SendingMode mode, bool only_in_front, bool used_here,
                                           const ScreenView& screen);

// The user's own switch: set on the local socket, followed by the touch path. Any thread.
class SendingSwitch {
 public:
  // `at_start`: auto, on or off.
  SendingSwitch(const std::string& at_start, bool only_in_front);

  // Adds the command "send" to `control`, which this must outlive: {"command":"send","mode":"on"}, or auto, off,
  // toggle.
  void serve(ControlServer& control);

  // Off, or again as it was before.
  void toggle();

  [[nodiscard]] SendingMode mode() const noexcept { return mode_; }
  [[nodiscard]] SendingVerdict judge(const ScreenView& screen, bool used_here) const {
    return judge_sending(mode_, only_in_front_, used_here, screen);
  }

 private:
  nlohmann::json set(const nlohmann::json& request);
  void set(SendingMode mode);

  std::atomic<SendingMode> mode_;
  std::atomic<SendingMode> before_off_ = SendingMode::automatic;
  const bool only_in_front_;
};

[[nodiscard]] const char* name_of(SendingMode mode);

}  // namespace telehug
