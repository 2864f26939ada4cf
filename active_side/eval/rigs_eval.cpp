// SPDX-License-Identifier: Apache-2.0
#include "eval/rigs_eval.hpp"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <thread>

namespace telehug {

std::vector<RigOutcome> eval_rigs(const EvalRigsOptions& options, const std::function<void(std::size_t)>& progress) {
  std::vector<RigOutcome> outcomes(options.count);
  std::atomic<std::size_t> next = 0;
  std::mutex telling;
  std::size_t done = 0;
  const auto work = [&] {
    for (std::size_t i = next++; i < options.count; i = next++) {
      outcomes[i] = evaluate_virtual_rig(options.first_seed + i, options.rig);
      const std::lock_guard lock(telling);
      progress(++done);
    }
  };
  std::vector<std::jthread> threads;
  for (std::size_t job = 0; job < std::min(options.jobs, options.count); ++job)
    threads.emplace_back(work);
  threads.clear();  // waits for them
  return outcomes;
}

}  // namespace telehug
