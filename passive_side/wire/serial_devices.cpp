// SPDX-License-Identifier: Apache-2.0
#include "wire/serial_devices.hpp"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace telehug {

std::vector<std::string> serial_devices(const std::filesystem::path& folder) {
  std::vector<std::string> paths;
  std::error_code error;
  for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
    paths.push_back(entry->path());
  std::ranges::sort(paths);
  return paths;
}

Result<std::string> only_serial_device(const std::filesystem::path& folder) {
  auto paths = serial_devices(folder);
  if (paths.empty()) return Error{"no serial device is plugged in; plug the jacket in"};
  if (paths.size() > 1) {
    return Error{fmt::format("there are {} serial devices; name the jacket's, one of serial:{}", paths.size(),
                             fmt::join(paths, ", serial:"))};
  }
  return std::move(paths.front());
}

}  // namespace telehug
