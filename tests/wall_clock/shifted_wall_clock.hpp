// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace telehug {

// The wall clock of the programs that are started with it, as a test sets it.
class ShiftedWallClock {
 public:
  // `file`: where the shift is kept, at least as long as the programs run.
  explicit ShiftedWallClock(std::filesystem::path file) : file_(std::move(file)) { shift(std::chrono::seconds(0)); }

  // Steps the clock of all of them to this PC's and so much.
  void shift(std::chrono::seconds by) {
    const std::int64_t ns = std::chrono::nanoseconds(by).count();
    // Written over, not anew: the programs have it mapped.
    std::fstream out(file_, std::ios::binary | std::ios::in | std::ios::out);
    if (!out) out.open(file_, std::ios::binary | std::ios::out);
    out.write(reinterpret_cast<const char*>(&ns), sizeof ns);
    if (!out.flush()) throw std::runtime_error(file_.string() + " can't be written");
  }

  // What stands before a program's command line.
  [[nodiscard]] std::vector<std::string> prefix() const {
    return {"/usr/bin/env", "LD_PRELOAD=" TELEHUG_WALL_CLOCK_SHIM, "TELEHUG_TEST_WALL_CLOCK=" + file_.string()};
  }

 private:
  std::filesystem::path file_;
};

}  // namespace telehug
