// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace telehug {

// An empty folder below the system's one for temporary files; it goes away with the value.
class TemporaryDirectory {
 public:
  TemporaryDirectory();  // throws std::system_error
  ~TemporaryDirectory();
  TemporaryDirectory(const TemporaryDirectory&) = delete;
  TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace telehug
