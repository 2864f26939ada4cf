// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "common/clock.hpp"
#include "common/result.hpp"

namespace telehug {

struct ProgramRun {
  int code = -1;           // its exit code; -1: a signal ended it
  bool timed_out = false;  // it was killed because it took longer
  std::string output;      // both streams; what is beyond 1 MiB is left out
};

// Runs a program, looked for in $PATH, to its end, in the C locale and without input. An error if it can't be started;
// `missing` becomes its sentence if there is no such program.
[[nodiscard]] Result<ProgramRun> run_program(std::vector<std::string> command, Duration longest,
                                             const std::string& missing);

}  // namespace telehug
