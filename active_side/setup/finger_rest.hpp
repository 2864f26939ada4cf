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
// The circle: of 189 touches of lit dots on 21 random rigs (of 700 to 723), three pictures each, the tip net saw 187;
// it placed all three within 1.2 mm of the first in 93 % of them and within 2.7 mm in 98 %. A hand that passes at 20
// mm/s leaves it within half a second, one that shakes by 5 mm to both sides leaves it again and again. Frames in which
// the finger is missed or misplaced are forgiven, up to a fifth.
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
