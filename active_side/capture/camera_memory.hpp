// SPDX-License-Identifier: Apache-2.0
//
// Settings of a camera in a file, TOML:
//
//   device = "/dev/v4l/by-id/usb-...-video-index0"
//   controls = [[0x009a0901, 3], [0x009a0902, 250]]   # V4L2_CID_... and value, in the order in which to set them
//
// Two of them are kept: what `camera tune` found, and what was set before telehug changed anything (see CameraSetup).
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "capture/camera_controls.hpp"
#include "common/result.hpp"

namespace telehug {

struct CameraMemory {
  std::string device;
  ControlValues controls;
};

// Nothing if there is no such file.
Result<std::optional<CameraMemory>> read_camera_memory(const std::filesystem::path& path);

// Makes the folder if need be. The file is there completely or not at all, also after a crash.
Status write_camera_memory(const std::filesystem::path& path, const CameraMemory& memory);

}  // namespace telehug
