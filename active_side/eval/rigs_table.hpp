// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "eval/error_group.hpp"
#include "eval/rigs_eval.hpp"

namespace telehug {

// What one algorithm made of all rigs.
struct RigsSummary {
  std::size_t rigs = 0;
  std::size_t not_calibrated = 0;
  ErrorGroup all;
  ErrorGroups groups;
  std::map<std::string, ErrorGroup> rests;  // see rest_group()
  std::size_t extras = 0;                   // beside real touches
  std::size_t frames_with_extras = 0;
};

// `algorithm` is its place in EvalRigsOptions.
RigsSummary summarise(const std::vector<RigOutcome>& outcomes, std::size_t algorithm);

// A group's mean error as a multiple of everybody's; 0 where there is none.
struct ErrorRatio {
  double near_vertical = 0;
  double near_horizontal = 0;
  double vertical = 0;  // of all that were found
  double horizontal = 0;
  bool stands_out = false;  // one is above 1.5, of 100 touches or more
};
ErrorRatio error_ratio(const ErrorGroup& group, const ErrorGroup& all);

// The table that `eval rigs` prints for one of its algorithms: as that of `eval touch`, with the ratios, the false
// touches by kind, and the rigs that were not calibrated with the reasons.
std::string format_rigs_table(const EvalRigsOptions& options, const std::vector<RigOutcome>& outcomes,
                              std::size_t algorithm);

}  // namespace telehug
