// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "calibration/border_candidates.hpp"
#include "calibration/calibration.hpp"
#include "common/result.hpp"

namespace telehug {

struct BorderChosen {
  RigCalibration calibration;         // with the chosen candidate's points as its border
  std::optional<std::size_t> chosen;  // index of the candidate; none if none agrees
  bool clear = false;                 // no other candidate agrees nearly as well
};

// Solves the rig with each candidate as the screen's bottom edge and chooses the one that agrees best with touches,
// marks and priors; candidates that contradict them are not used. If another agrees nearly as well, the chosen one's
// standard deviation becomes their distance. `observations.border` is replaced.
Result<BorderChosen> solve_with_border(RigObservations observations, const std::vector<BorderCandidate>& candidates,
                                       const RigSolverOptions& options = {});

}  // namespace telehug
