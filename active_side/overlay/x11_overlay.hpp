// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <opencv2/core/types.hpp>
#include <optional>
#include <string>
#include <vector>

#include "common/clock.hpp"
#include "common/result.hpp"
#include "overlay/x11_outline_window.hpp"

namespace telehug {

enum class OverlayState {
  touched,  // red
  felt,     // the other side has felt it: green, and twice as wide
  hugged,   // the other side hugs back: pink, and as wide
};

struct X11OverlayConfig {
  std::string display = {};  // empty: $DISPLAY
  std::string monitor = {};  // its name for RandR ("HDMI-1"); empty: the primary one, else the first
  int line_px = 3;           // > 0
};

// Outlines a box on a monitor, above all windows and without being in the way: clicks go through. Needs no compositor,
// for the window consists of nothing but the lines. Costs no request while nothing changes. If the server goes away, it
// is looked for once a second, for as long as there is something to show. One thread uses an
// overlay.
class X11Overlay {
 public:
  X11Overlay(X11OverlayConfig config, const Clock& clock);  // `clock` outlives the overlay

  // Idempotent. Fails if the display can't be used.
  Status open();
  void close();

  // Px of the monitor; what lies outside of it isn't shown. To be called again and again while the box is touched:
  // brings the lines back above windows that were put over them.
  void show(const cv::Rect& box_px, OverlayState state);
  void hide();

  // The px of the monitor that show() covers now, or would if it were felt; empty while nothing is shown. A
  // picture of the monitor doesn't show what is beneath.
  [[nodiscard]] std::vector<cv::Rect> areas() const;

  // One sentence about why nothing is shown though it should be; empty if all is well.
  [[nodiscard]] const std::string& last_error() const noexcept { return last_error_; }

 private:
  void update();
  Status connect();

  X11OverlayConfig config_;
  const Clock& clock_;
  bool open_ = false;
  Timestamp next_try_;  // to reach the server
  std::unique_ptr<X11OutlineWindow> window_;
  std::optional<cv::Rect> box_px_;  // that is to be shown
  OverlayState state_ = OverlayState::touched;
  std::string last_error_;
};

}  // namespace telehug
