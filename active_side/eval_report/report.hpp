// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/units.hpp"
#include "eval/error_group.hpp"
#include "eval/failure_pictures.hpp"
#include "eval/touch_score.hpp"

namespace telehug {

// What one algorithm did altogether and in each group.
struct ReportedAlgorithm {
  std::string name;     // "detector default, model default"
  std::string failure;  // why there is nothing else; empty: there is
  ErrorGroup all;
  ErrorGroups groups;
  ErrorGroups rests;       // frames without a touch, by why there is none
  std::size_t extras = 0;  // points beside real touches
};

struct ReportedTouch {
  std::string frame;
  ScreenSize screen;
  std::vector<std::string> groups;
  ScoredTouch touch;
};

// A touch of the calibration: where it was, and where the solved model places it minus that.
struct CalibrationError {
  std::string name;
  ScreenPoint place;
  ScreenPoint error_mm;
};

// All that a page about an evaluation shows, as plain values.
struct Report {
  std::string title;
  std::string date;                                        // when it was evaluated; ISO 8601, UTC
  std::vector<std::pair<std::string, std::string>> facts;  // what was evaluated and how, in words
  std::vector<ReportedAlgorithm> algorithms;               // the first is what the rest is about, others to compare
  std::vector<ReportedTouch> touches;
  bool one_screen = true;                     // all touches were on the same one; else places are shown as shares of it
  std::vector<CalibrationError> calibration;  // of one rig
  std::vector<std::string> faults;            // what could not be evaluated, and why
  std::vector<FailurePicture> failures;
};

}  // namespace telehug
