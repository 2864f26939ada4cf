// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "common/clock.hpp"
#include "common/result.hpp"
#include "overlay/key_combination.hpp"

namespace telehug {

class X11KeyGrab;

struct X11HotkeyConfig {
  std::string display = {};  // empty: $DISPLAY
  std::string keys;          // "Ctrl+Alt+H", see key_combination.hpp
};

// A key combination that reaches telehug whichever window is used at the time, and that one alone. If the server goes
// away it is looked for once a second. One thread uses a hotkey.
class X11Hotkey {
 public:
  X11Hotkey(X11HotkeyConfig config, const Clock& clock);  // `clock` outlives the hotkey
  ~X11Hotkey();
  X11Hotkey(const X11Hotkey&) = delete;
  X11Hotkey& operator=(const X11Hotkey&) = delete;

  // Idempotent. Fails if the text is no combination, the display can't be used, or another program has the
  // combination.
  Status open();
  void close();
  [[nodiscard]] bool is_open() const noexcept { return open_; }

  // True once for each time that the combination was pressed, however long it was held. Never waits for one.
  bool pressed();

  // One sentence about why no press is noticed now; empty if all is well.
  [[nodiscard]] const std::string& last_error() const noexcept { return last_error_; }

 private:
  Status connect();

  X11HotkeyConfig config_;
  const Clock& clock_;
  bool open_ = false;
  Timestamp next_try_;  // to reach the server
  std::unique_ptr<X11KeyGrab> grab_;
  int presses_ = 0;  // that are still to be told
  std::string last_error_;
};

}  // namespace telehug
