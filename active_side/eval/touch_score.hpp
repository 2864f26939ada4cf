// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "capture/rig_directory.hpp"
#include "common/units.hpp"

namespace telehug {

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
};

// A frame in which nothing touches.
struct ScoredRest {
  std::string frame;
  std::string tone;
  std::string screen;
  std::string kind;  // first word of the notes: hover, away, nohand
  std::size_t false_touches = 0;
};

struct TouchScore {
  std::vector<ScoredTouch> touches;
  std::vector<ScoredRest> rests;
  std::size_t extra_touches = 0;  // points beyond the real ones, in frames with a touch
};

// Pairs what was found with the truth, frame by frame, the nearest pair first, however far apart. Frames without a row
// in `truth` are left out.
TouchScore score_touches(const std::vector<FoundTouches>& found, const std::vector<TruthRow>& truth);

}  // namespace telehug
