// SPDX-License-Identifier: Apache-2.0
#include "netlab/run_inside.hpp"

#include <unistd.h>

#include <stdexcept>

#include "doubles/child_program.hpp"

namespace telehug {

void run_inside(const NetNamespace& network, const std::vector<std::string>& command) {
  const InsideNamespace inside(network);
  if (ChildProgram(command).wait_for_end() == 0) return;
  std::string failed = "failed:";
  for (const std::string& word : command)
    failed += " " + word;
  throw std::runtime_error(failed);
}

std::string path_of(const NetNamespace& network) {
  return "/proc/" + std::to_string(getpid()) + "/fd/" + std::to_string(network.descriptor());
}

}  // namespace telehug
