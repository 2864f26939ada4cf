// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "capture/frame.hpp"
#include "common/clock.hpp"
#include "common/result.hpp"
#include "common/row_range.hpp"
#include "common/units.hpp"

namespace telehug {

enum class ReadOutcome {
  frame,    // `frame` was filled
  timeout,  // no picture within the time
  broken,   // a picture came that can't be decoded; it is counted, the next one may be good
  lost,     // the device is gone or was never there; read() tries to get it back, last_error() says why
  ended,    // a recording is over
};

// Where pictures come from: webcam, recording, virtual rig. One thread uses a source.
class FrameSource {
 public:
  virtual ~FrameSource() = default;

  // Opens the device (idempotent). A source that can't be opened now may be opened later.
  virtual Status open() = 0;

  // Closes the device (idempotent): the webcam's light goes out.
  virtual void close() = 0;

  [[nodiscard]] virtual bool is_open() const = 0;

  // From the next read() on only these rows are needed, until other ones are; at first all are. A source to which that
  // saves work may leave the others as they are in the frame; Frame::rows tells which it filled. Costs nothing.
  virtual void need_rows(RowRange /*rows*/) {}

  // Waits at most `timeout` for the next picture and fills `frame`, whose buffer is reused. Never throws; never blocks
  // longer. After `lost` the source looks for its device again by itself (at most every 500 ms).
  virtual ReadOutcome read(Frame& frame, Duration timeout) = 0;

  // One sentence about the newest `broken` or `lost`; empty if there was none.
  [[nodiscard]] virtual std::string last_error() const = 0;

  // What status and calibration files call this source: "webcam /dev/v4l/by-id/...", "recording DIR", "virtual".
  [[nodiscard]] virtual std::string name() const = 0;

  // What was set for these pictures and what of it did not work, for status; empty: nothing was changed.
  [[nodiscard]] virtual std::string setup() const { return {}; }

  // Size of the pictures; 0x0 until open.
  [[nodiscard]] virtual ImageSize size() const = 0;
};

}  // namespace telehug
