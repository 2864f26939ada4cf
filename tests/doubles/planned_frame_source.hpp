// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "capture/frame_source.hpp"

namespace telehug {

// Delivers the picture and the outcome that a test has laid down, and keeps what was asked of it.
class PlannedFrameSource final : public FrameSource {
 public:
  Status open() override {
    if (!can_open) return Error{"The card is not plugged in."};
    opened = true;
    return Done{};
  }
  void close() override {
    opened = false;
    ++closes;
  }
  [[nodiscard]] bool is_open() const override { return opened; }
  void need_rows(RowRange rows) override { needed = rows; }
  ReadOutcome read(Frame& frame, Duration timeout) override {
    longest_wait = std::max(longest_wait, timeout);
    if (outcome == ReadOutcome::frame) picture.copyTo(frame.bgr);
    return outcome;
  }
  [[nodiscard]] std::string last_error() const override { return error; }
  [[nodiscard]] std::string name() const override { return "planned source"; }
  [[nodiscard]] ImageSize size() const override { return {picture.cols, picture.rows}; }

  cv::Mat picture;
  ReadOutcome outcome = ReadOutcome::frame;
  std::string error;
  bool can_open = true;

  bool opened = false;
  int closes = 0;
  RowRange needed;
  Duration longest_wait{};
};

}  // namespace telehug
