// SPDX-License-Identifier: Apache-2.0
//
// Where the files lie that come with the programs: jacket profiles, face model, firmware.
#pragma once

#include <filesystem>
#include <system_error>

namespace telehug {

// Found from the program that runs, so that an installation may lie anywhere and be moved: share/telehug beside its own
// folder. The build tree has the same (CMakeLists.txt).
[[nodiscard]] inline std::filesystem::path data_folder() {
  std::error_code ignored;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", ignored);
  return program.parent_path().parent_path() / "share/telehug";
}

}  // namespace telehug
