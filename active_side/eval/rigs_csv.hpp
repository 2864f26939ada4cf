// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "common/result.hpp"
#include "eval/rigs_eval.hpp"

namespace telehug {

// A row a touch (touch, or missed), a frame without one (rest, or false for each that was found all the same), a point
// beside real touches (extra) and a rig that was not calibrated (failed), of every algorithm.
Status write_rigs_csv(const std::filesystem::path& path, const EvalRigsOptions& options,
                      const std::vector<RigOutcome>& outcomes);

}  // namespace telehug
