// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/result.hpp"

namespace telehug {

// Where udev names serial devices by what they are, so that they keep their names wherever they are plugged in.
inline constexpr const char* serial_devices_folder = "/dev/serial/by-id";

// Their paths, sorted; empty if there are none.
[[nodiscard]] std::vector<std::string> serial_devices(const std::filesystem::path& folder);

// The path of the only one there is; the error tells which there are.
[[nodiscard]] Result<std::string> only_serial_device(const std::filesystem::path& folder);

}  // namespace telehug
