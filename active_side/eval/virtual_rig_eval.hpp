// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "eval/failure_pictures.hpp"
#include "eval/rig_evaluator.hpp"
#include "eval/touch_score.hpp"

namespace telehug {

struct VirtualRigEval {
  int frames = 5;                             // single pictures a rig: see random_frame.hpp
  int hard = 1;                               // with two fingers or two hands
  int dots = 9;                               // touches of known points that calibrate it
  std::vector<EvalAlgorithm> algorithms{{}};  // each on the same pictures
  bool failure_pictures = false;              // are they wanted; of the first algorithm
};

// What an algorithm made of a rig's pictures. Frames are called "frames/013" and "hard/002", as `record` calls them.
struct AlgorithmOutcome {
  std::string failure;  // why it was not calibrated; empty: it was
  TouchScore score;
  std::vector<ScreenPoint> calibration_errors_mm;  // where the model places the calibration's touches, minus where
                                                   // they were; none with the thesis', which fits its two exactly
  std::vector<FailurePicture> failures;            // if they are wanted
};

struct RigOutcome {
  std::uint64_t seed = 0;
  ScreenSize screen;
  std::string coat;
  std::vector<std::string> groups;  // see rig_groups.hpp
  std::vector<AlgorithmOutcome> algorithms;
  std::chrono::nanoseconds drawing{};
  std::chrono::nanoseconds evaluating{};
};

// Draws random_rig(seed), its calibration and its frames, with each picture going through a JPEG file, and evaluates
// what each algorithm finds. Rigs take turns at the kinds of frames, so that a few frames of many rigs hold all of
// them. Whatever goes wrong is the outcome's failure.
RigOutcome evaluate_virtual_rig(std::uint64_t seed, const VirtualRigEval& options);

}  // namespace telehug
