// SPDX-License-Identifier: Apache-2.0
//
// `telehug-active eval touch`: what a detector and a touch model make of a recording, and how far that is from the
// truth.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "calibration/calibration.hpp"
#include "common/result.hpp"
#include "eval/failure_pictures.hpp"
#include "eval/rig_evaluator.hpp"
#include "eval/touch_score.hpp"

namespace telehug {

struct EvalTouchOptions {
  std::filesystem::path rig;      // a recording, see capture/rig_directory.hpp
  std::filesystem::path out;      // CSV: frame,contact,x_mm,y_mm; empty: none is written
  std::string part = "frames";    // frames, hard (each picture alone), sequence (one 30 Hz recording)
  EvalAlgorithm algorithm;        // which detector and model
  std::vector<int> calibration;   // numbers of the calibration frames; empty: what the model uses (thesis: 1, 2;
                                  // default: all)
  bool failure_pictures = false;  // are they wanted
};

struct EvalTouchReport {
  EvalTouchOptions options;
  Calibration calibration;
  EvaluatedPart part;
  std::optional<TouchScore> score;       // if the part has a truth
  std::vector<FailurePicture> failures;  // if they are wanted, the biggest of each kind
};

// The error says which option, file or calibration picture is wrong.
Result<EvalTouchReport> eval_touch(const EvalTouchOptions& options);

}  // namespace telehug
