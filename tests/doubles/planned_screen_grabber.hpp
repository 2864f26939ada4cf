// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "screen/screen_grabber.hpp"

namespace telehug {

// Returns the picture and the outcome that a test has laid down.
class PlannedScreenGrabber final : public ScreenGrabber {
 public:
  Status open() override { return Done{}; }
  void close() override {}
  [[nodiscard]] bool is_open() const override { return true; }
  GrabOutcome grab(ScreenPicture& filled) override {
    if (outcome == GrabOutcome::changed) {
      filled = picture;
    }
    filled.time = picture.time;
    filled.in_front = picture.in_front;
    return outcome;
  }
  [[nodiscard]] bool is_live() const override { return live; }
  [[nodiscard]] std::string name() const override { return "planned"; }
  [[nodiscard]] std::string last_error() const override { return "The screen is gone."; }

  ScreenPicture picture;
  GrabOutcome outcome = GrabOutcome::changed;
  bool live = false;
};

}  // namespace telehug
