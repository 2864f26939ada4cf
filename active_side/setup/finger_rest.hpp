// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "common/clock.hpp"
#include "common/units.hpp"

namespace telehug {

// Whether a finger rests: it has been seen within a small circle for a while.
//
// The circle: where the tip net places a resting finger on a lit dot scatters by 0.1 to 1 mm from frame to frame
// (215 touches on 24 random rigs, three pictures each: 90 % lie within 1.2 mm of the first, 97 % within 2.7 mm). A hand
// that passes at 20 mm/s leaves it within a quarter of a second, one that shakes by 5 mm to both sides leaves it with
// every other frame. Frames in which the finger is missed or misplaced are forgiven, up to a fifth.
struct RestRule {
  Duration rest = 600ms;
  double radius_mm = 3;
  double forgiven = 0.2;         // of the frames
  std::size_t least_frames = 8;  // seen in the circle
};

class FingerRest {
 public:
  explicit FingerRest(const RestRule& rule = {}) : rule_(rule) {}

  // Where the finger is in this frame, read as a touch; nothing if none is seen. `now` never decreases.
  void look(const std::optional<ScreenPoint>& finger, Timestamp now);
  void forget();

  // 0 to 1; 1: it rests.
  [[nodiscard]] double progress() const noexcept;
  [[nodiscard]] bool rests() const noexcept { return progress() >= 1; }
  // The middle (median) of where it has been seen since it stopped; nothing if no finger is there.
  [[nodiscard]] std::optional<ScreenPoint> place() const;
  [[nodiscard]] Duration still_for() const noexcept { return places_.empty() ? Duration{} : now_ - since_; }

 private:
  void begin(const ScreenPoint& finger, Timestamp now);

  RestRule rule_;
  std::vector<ScreenPoint> places_;  // the last ones in the circle
  std::size_t frames_ = 0;
  std::size_t missed_ = 0;
  Timestamp since_;
  Timestamp now_;
};

}  // namespace telehug
