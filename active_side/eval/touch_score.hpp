// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "capture/rig_directory.hpp"
#include "common/units.hpp"

namespace telehug {

// A found touch farther than this from the truth is counted as wrong.
inline constexpr double near_enough_mm = 10;

// What was found in one frame.
struct FoundTouches {
  std::string frame;
  std::vector<ScreenPoint> points;
};

// A real touch and what was found of it.
struct ScoredTouch {
  std::string frame;
  std::string tone;
  std::string screen;  // without the number: "chat", not "chat2"
  bool found = false;
  double vertical_error_mm = 0;    // found minus true; only if found
  double horizontal_error_mm = 0;  // likewise
  ScreenPoint place = {};          // where it really was
  std::string notes = {};          // what is special about the hand, see TruthRow

  [[nodiscard]] double error_mm() const { return std::hypot(vertical_error_mm, horizontal_error_mm); }
  [[nodiscard]] bool near() const { return found && error_mm() <= near_enough_mm; }
  [[nodiscard]] ScreenPoint found_place() const {
    return {place.x_mm + horizontal_error_mm, place.y_mm + vertical_error_mm};
  }
};

// A frame in which nothing touches.
struct ScoredRest {
  std::string frame;
  std::string tone;
  std::string screen;
  std::string kind;                             // first word of the notes: hover, away, nohand
  std::vector<ScreenPoint> false_touches = {};  // what was found all the same
  std::optional<double> hover_mm = {};          // if it is known
  std::string notes = {};
};

// A point beyond the real touches of a frame.
struct ExtraTouch {
  std::string frame;
  ScreenPoint place;
};

struct TouchScore {
  std::vector<ScoredTouch> touches;
  std::vector<ScoredRest> rests;
  std::vector<ExtraTouch> extras;
};

// Pairs what was found with the truth, frame by frame, the nearest pair first, however far apart. Frames without a row
// in `truth` are left out.
TouchScore score_touches(const std::vector<FoundTouches>& found, const std::vector<TruthRow>& truth);

}  // namespace telehug
