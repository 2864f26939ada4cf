// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>
#include <unistd.h>

#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

namespace telehug {

// What a process has used so far, from Linux' proc(5).
struct ProcessUse {
  double cpu_s = 0;    // all its threads, in user and kernel mode
  long memory_kb = 0;  // resident
  int threads = 0;
};

// Throws if there is no such process.
inline ProcessUse use_of(pid_t pid) {
  const std::string folder = "/proc/" + std::to_string(pid);
  std::ifstream stat(folder + "/stat");
  std::string line;
  std::getline(stat, line);
  const auto name_end = line.rfind(')');  // the program's name may hold anything
  if (name_end == std::string::npos) throw std::runtime_error("a program has ended");
  std::istringstream fields(line.substr(name_end + 1));
  std::string skipped;
  constexpr int fields_between_name_and_utime = 11;
  for (int field = 0; field < fields_between_name_and_utime; ++field)
    fields >> skipped;
  long user_ticks = 0;
  long system_ticks = 0;
  fields >> user_ticks >> system_ticks;
  long children_ticks = 0;
  long priority = 0;
  ProcessUse use;
  fields >> children_ticks >> children_ticks >> priority >> priority >> use.threads;
  use.cpu_s = static_cast<double>(user_ticks + system_ticks) / static_cast<double>(sysconf(_SC_CLK_TCK));
  long pages = 0;
  std::ifstream statm(folder + "/statm");
  statm >> pages >> pages;  // the second number
  use.memory_kb = pages * (sysconf(_SC_PAGESIZE) / 1024);
  return use;
}

}  // namespace telehug
