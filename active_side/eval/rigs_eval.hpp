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

// The outcomes in the seeds' order, the same for any number of jobs. `progress` is told how many rigs are done, by one
// thread at a time.
std::vector<RigOutcome> eval_rigs(const EvalRigsOptions& options, const std::function<void(std::size_t)>& progress);

}  // namespace telehug
