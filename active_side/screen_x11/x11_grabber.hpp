// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "screen/screen_grabber.hpp"
#include "screen_x11/left_out_areas.hpp"
#include "screen_x11/x11_grabber_config.hpp"
#include "screen_x11/x11_watch.hpp"

namespace telehug {

// Watches a monitor, or one window even while others cover it, through an X server. Pictures are CV_8UC4 in memory
// that the server fills; nothing is copied, and a screen on which nothing is drawn costs no request. The window is
// found again when it reappears, the monitor when it is plugged in, the server when it is back (looked for once a
// second).
class X11Grabber final : public ScreenGrabber {
 public:
  X11Grabber(X11GrabberConfig config, const Clock& clock);  // `clock` outlives the grabber

  // Fails if there is no display or it can't be read; a missing monitor or window is only `lost`.
  Status open() override;
  void close() override;
  [[nodiscard]] bool is_open() const override { return open_; }
  GrabOutcome grab(ScreenPicture& picture) override;
  [[nodiscard]] bool is_live() const override { return true; }
  [[nodiscard]] bool pins_window() const override { return !config_.window.empty(); }
  [[nodiscard]] std::string name() const override;
  [[nodiscard]] std::string last_error() const override { return last_error_; }

  // Parts of the monitor that count for nothing from now on, px of it: what is drawn there is no change, and pictures
  // go on showing what they showed there. For telehug's own overlay; a pinned window's pictures don't contain that
  // anyway, so they stay whole.
  void leave_out(const std::vector<cv::Rect>& areas_px) override;

 private:
  Status connect();
  GrabOutcome grab_from(X11Watch& watch, ScreenPicture& picture);
  bool is_drawn_in(const X11View& view, const std::vector<cv::Rect>& damage_px);
  cv::Mat read_keeping(X11Watch& watch, const X11View& view);
  GrabOutcome judge_black(GrabOutcome outcome);
  GrabOutcome lose(std::string why);

  X11GrabberConfig config_;
  const Clock& clock_;
  bool open_ = false;
  bool on_wayland_ = false;
  Timestamp next_try_;  // to reach the server
  std::unique_ptr<X11Watch> watch_;
  std::optional<X11View> shown_;  // what the last grab returned; none after `lost`
  cv::Mat pixels_;                // of that; shared with watch_
  bool black_ = false;            // they are, and that would mean something
  int black_grabs_ = 0;           // in a row
  std::vector<cv::Rect> left_out_px_;
  bool left_out_drawn_ = false;  // something was drawn there since they were set
  bool stale_ = false;           // the pictures may lack something that was drawn
  KeptAreas kept_;
  std::string last_error_;
};

}  // namespace telehug
