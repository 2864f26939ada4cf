// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "calibration/calibration.hpp"
#include "capture/rig_directory.hpp"
#include "common/result.hpp"
#include "eval/touch_score.hpp"
#include "finger/border_strip.hpp"

namespace telehug {

// Which algorithm: of detector and model each "thesis" or "default".
struct EvalAlgorithm {
  std::string detector = "default";
  std::string model = "default";
};

inline const EvalAlgorithm thesis_algorithm{"thesis", "thesis"};

// The error says which option is wrong.
Status check_algorithm(const EvalAlgorithm& algorithm);

// A recorded rig as the algorithm sees it after calibration, with nobody there.
struct EvaluatedRig {
  Calibration calibration;
  std::string detector;              // as in EvalAlgorithm
  std::optional<BorderStrip> empty;  // nobody there; the thesis' detector needs none
};

// `calibration`: numbers of the calibration pictures to use, see rig_calibration.hpp. The error says which picture is
// missing or unfit and why.
Result<EvaluatedRig> calibrate_rig(const RigDirectory& recording, const EvalAlgorithm& algorithm,
                                   const std::vector<int>& calibration);

// From a contact's first frame to the first one in which it has ended.
struct EvaluatedContact {
  std::uint32_t id = 0;
  std::string down;  // names of frames
  std::string up;    // empty: it did not end
};

struct EvaluatedPart {
  std::vector<FoundTouches> found;         // one a frame, in the part's order
  std::vector<std::string> unreadable;     // pictures that could not be used, and why; they count as without a touch
  std::vector<EvaluatedContact> contacts;  // of a sequence, in the order of their ids
  std::size_t dropped = 0;                 // fingers whose point lay too far outside the screen
};

// What is found in the pictures of a part by a new detector: each alone, but those of `sequence` with the tracker.
EvaluatedPart evaluate_part(const EvaluatedRig& rig, const RigPart& part);

}  // namespace telehug
