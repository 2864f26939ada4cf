// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <opencv2/core/types.hpp>
#include <optional>
#include <string>

#include "capture/frame.hpp"
#include "screen/screen_grabber.hpp"

namespace telehug {

class FrameSource;

struct FrameGrabberConfig {
  std::optional<cv::Rect> region = {};  // the part to look at, px of the source's pictures; none: all of them
  bool live = true;                     // a device that shows the monitor now; false: a recording
};

// Takes the pictures of a camera source for the screen: of a capture card or a loopback device that shows the rig's
// monitor, or of a recording. Each frame is the whole monitor, however many pixels the device makes of it. A capture
// card repeats a screen that stands still: frames that are equal in the region are `unchanged`, as is no new frame. But
// a live device that has delivered none for `longest_silence` shows no longer what happens now: it is `lost`.
class FrameGrabber final : public ScreenGrabber {
 public:
  static constexpr Duration longest_silence = 2s;

  // `source` is one whose newest waiting frame is read first, as a webcam's is; `clock` outlives the grabber.
  FrameGrabber(std::unique_ptr<FrameSource> source, const FrameGrabberConfig& config, const Clock& clock);
  ~FrameGrabber() override;

  Status open() override;
  void close() override;
  [[nodiscard]] bool is_open() const override { return open_; }
  GrabOutcome grab(ScreenPicture& picture) override;
  [[nodiscard]] bool is_live() const override { return config_.live; }
  [[nodiscard]] std::string name() const override;
  [[nodiscard]] std::string last_error() const override { return last_error_; }

 private:
  GrabOutcome show_newest(ScreenPicture& picture);
  GrabOutcome nothing_new(Timestamp now, const std::string& why);
  GrabOutcome lose(std::string why);

  std::unique_ptr<FrameSource> source_;
  FrameGrabberConfig config_;
  const Clock& clock_;
  bool open_ = false;
  Timestamp heard_;         // when a frame came last, or the device was opened or got lost
  Frame incoming_;          // is read into; becomes shown_ if it differs
  Frame shown_;             // what the last `changed` lent out
  cv::Rect part_;           // of shown_ that is looked at
  bool has_shown_ = false;  // not after `lost`
  std::string last_error_;
};

}  // namespace telehug
