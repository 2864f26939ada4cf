// SPDX-License-Identifier: Apache-2.0
//
// `telehug-active eval rigs`: algorithms on many rigs drawn at random.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "eval/virtual_rig_eval.hpp"

namespace telehug {

struct EvalRigsOptions {
  std::uint64_t first_seed = 1;
  std::size_t count = 30;
  std::size_t jobs = 1;  // threads, each with a rig of its own
  VirtualRigEval rig;
};

struct RigsResult {
  std::vector<RigOutcome> rigs;          // in the seeds' order; without their failures' pictures
  std::vector<FailurePicture> failures;  // the biggest of each kind; frames are called as "virtual:7 frames/013"
};

// The same for any number of jobs. `progress` is told how many rigs are done, by one thread at a time.
RigsResult eval_rigs(const EvalRigsOptions& options, const std::function<void(std::size_t)>& progress);

}  // namespace telehug
