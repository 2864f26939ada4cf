// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>

#include "common/result.hpp"

namespace telehug {

// A new file that nobody but its owner may read, for pictures of people and for keys. Errors name the file and say what
// to do.
class PrivateFile {
 public:
  // Mode 0600. A file or link that is there already is an error: it could be somebody else's.
  static Result<PrivateFile> create(std::filesystem::path path);
  ~PrivateFile();
  PrivateFile(PrivateFile&& other) noexcept;
  PrivateFile(const PrivateFile&) = delete;
  PrivateFile& operator=(const PrivateFile&) = delete;
  PrivateFile& operator=(PrivateFile&&) = delete;

  // All of it or, after an error, nothing: a file that is read meanwhile or later holds no half of a line.
  Status append(std::string_view text);
  Status append(std::span<const std::uint8_t> bytes);

  // What was written survives a power cut from here on.
  Status sync();
  // Says whether all of it has arrived.
  Status close();

 private:
  PrivateFile(std::filesystem::path path, int descriptor);

  std::filesystem::path path_;
  int descriptor_ = -1;
  std::int64_t bytes_ = 0;  // written so far
};

// A folder of mode 0700, which must not be there yet.
Status make_private_folder(const std::filesystem::path& folder);

// A whole file of mode 0600, which appears under its name when it is complete.
Status write_private_file(const std::filesystem::path& path, std::span<const std::uint8_t> bytes);

// The same for what is kept: takes the place of what was there, and survives a power cut.
Status keep_private_file(const std::filesystem::path& path, std::string_view text);

}  // namespace telehug
