// SPDX-License-Identifier: Apache-2.0
#include "screen/picture_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string>
#include <system_error>

namespace telehug {
namespace fs = std::filesystem;
namespace {

bool named_like_a_picture(const fs::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return extension == ".jpg" || extension == ".jpeg" || extension == ".png";
}

}  // namespace

Result<std::vector<fs::path>> list_pictures(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) {
    return Error{fmt::format("There is no picture or folder of pictures at {}; check the path.", path.string())};
  }
  if (!fs::is_directory(status)) {
    return std::vector<fs::path>{path};
  }
  std::vector<fs::path> files;
  for (fs::directory_iterator entry(path, error), end; !error && entry != end; entry.increment(error)) {
    std::error_code ignored;
    if (named_like_a_picture(entry->path()) && entry->is_regular_file(ignored)) {
      files.push_back(entry->path());
    }
  }
  if (error) {
    return Error{
        fmt::format("The folder {} can't be read ({}); check its permissions.", path.string(), error.message())};
  }
  if (files.empty()) {
    return Error{fmt::format("The folder {} holds no picture (.jpg, .jpeg or .png); put one there.", path.string())};
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace telehug
