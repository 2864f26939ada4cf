// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "common/clock.hpp"
#include "common/result.hpp"
#include "common/units.hpp"

namespace telehug {

// The part of the rig's monitor in which the remote person is looked for: all of it, a window, or a rectangle. Its
// bottom is where the grid of boxes ends. Pixels of the monitor: origin at its top-left corner, x right, y down; real
// ones, as many as the monitor shows, whatever scale the desktop draws at.
struct ScreenPicture {
  cv::Mat bgr;          // CV_8UC3, or CV_8UC4 with an undefined fourth; shares its pixels with the grabber and holds
                        // until its next call
  cv::Point origin_px;  // where the picture's top-left corner lies on the monitor; within it
  ImageSize monitor;    // what origin_px and the picture's own pixels are counted in
  Timestamp time;       // when the screen was looked at
  std::optional<bool> in_front;  // does the pinned window lie in front of the others? none: no window is pinned
};

enum class GrabOutcome {
  changed,    // the picture was filled anew
  unchanged,  // the screen shows what it showed at the last grab: only `time` and `in_front` were set
  lost,       // there is no picture now; `time` was set, last_error() says why, a later grab may succeed
};

// Where pictures of the video chat come from: a file, a folder of recorded pictures, a screen. One thread uses a
// grabber.
class ScreenGrabber {
 public:
  virtual ~ScreenGrabber() = default;

  // Idempotent. A grabber that can't be opened now may be opened later.
  virtual Status open() = 0;

  // Idempotent; nothing of the screen is kept.
  virtual void close() = 0;

  [[nodiscard]] virtual bool is_open() const = 0;

  // Never throws and never waits for a change. The first grab after open() is never `unchanged`, nor is the one after
  // `lost`. `lost` if not open.
  virtual GrabOutcome grab(ScreenPicture& picture) = 0;

  // Parts of the monitor where telehug itself draws, px: from the next grab on what changes there is no change.
  // Grabbers whose pictures don't show that need not care.
  virtual void leave_out(const std::vector<cv::Rect>& /*areas_px*/) {}

  // Is it told to look at one window only, so that it knows whether that is in front?
  [[nodiscard]] virtual bool pins_window() const { return false; }

  // Does it show what happens now, so that somebody who never moves is a picture of somebody? Files don't.
  [[nodiscard]] virtual bool is_live() const = 0;

  // What status calls this grabber: "picture FILE".
  [[nodiscard]] virtual std::string name() const = 0;

  // One sentence that the user should know although all works; empty: nothing.
  [[nodiscard]] virtual std::string remark() const { return {}; }

  // One sentence about the newest `lost`, with what to do; empty if there was none.
  [[nodiscard]] virtual std::string last_error() const = 0;
};

}  // namespace telehug
