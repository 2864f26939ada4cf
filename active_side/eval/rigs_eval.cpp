// SPDX-License-Identifier: Apache-2.0
#include "eval/rigs_eval.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <mutex>
#include <thread>
#include <utility>

namespace telehug {

namespace {

// Only the biggest are kept, so that a run of many rigs needs no more memory for pictures than one of a few.
void collect_failures(RigOutcome& rig, std::vector<FailurePicture>& all) {
  for (AlgorithmOutcome& outcome : rig.algorithms) {
    for (FailurePicture& picture : std::exchange(outcome.failures, {})) {
      picture.failure.frame = fmt::format("virtual:{} {}", rig.seed, picture.failure.frame);
      all.push_back(std::move(picture));
    }
  }
  all = biggest(std::move(all), failures_kept);
}

}  // namespace

RigsResult eval_rigs(const EvalRigsOptions& options, const std::function<void(std::size_t)>& progress) {
  RigsResult result;
  result.rigs.resize(options.count);
  std::atomic<std::size_t> next = 0;
  std::mutex collecting;
  std::size_t done = 0;
  const auto work = [&] {
    for (std::size_t i = next++; i < options.count; i = next++) {
      RigOutcome rig = evaluate_virtual_rig(options.first_seed + i, options.rig);
      const std::lock_guard lock(collecting);
      collect_failures(rig, result.failures);
      result.rigs[i] = std::move(rig);
      progress(++done);
    }
  };
  std::vector<std::jthread> threads;
  const std::size_t jobs = std::min(options.jobs, options.count);
  threads.reserve(jobs);
  for (std::size_t job = 0; job < jobs; ++job)
    threads.emplace_back(work);
  threads.clear();  // waits for them
  return result;
}

}  // namespace telehug
