// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>
#include <string>

#include "common/clock.hpp"
#include "common/result.hpp"
#include "common/units.hpp"

namespace telehug {

// The part of the desktop in which the remote person is looked for: a screen, a window, or a rectangle of it. Its
// bottom is where the grid of boxes ends. Pixels of the desktop: origin at its top-left corner, x right, y down.
struct ScreenPicture {
  cv::Mat bgr;          // CV_8UC3; shares its pixels with the grabber and holds until the next grab
  cv::Point origin_px;  // where the picture's top-left corner lies on the desktop
  ImageSize desktop;    // what origin_px and the picture's own pixels are counted in
  Timestamp time;       // when the screen was looked at
};

enum class GrabOutcome {
  changed,    // the picture was filled anew
  unchanged,  // the screen shows what it showed at the last grab: only `time` was set
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

  // What status calls this grabber: "picture FILE".
  [[nodiscard]] virtual std::string name() const = 0;

  // One sentence about the newest `lost`; empty if there was none.
  [[nodiscard]] virtual std::string last_error() const = 0;
};

}  // namespace telehug
