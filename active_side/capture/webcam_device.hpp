// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/result.hpp"

namespace telehug {

// The first webcam under /dev/v4l/by-id, in order of names; else /dev/video0.
std::string first_webcam_device();

struct WebcamDevice {
  std::string path;  // /dev/v4l/by-id/...: stays the same camera wherever it is plugged in
  std::string name;  // for people, made of the path: "046d HD Pro Webcam C920"
};

// Those under `folder`, in order of names. A camera has further devices for its metadata, which are not among them.
std::vector<WebcamDevice> list_webcams(const std::filesystem::path& folder = "/dev/v4l/by-id");

// Why `device` could not be used, with what to do about it. `doing`: what was tried, as in "can't be opened"; `code`: a
// negative errno.
Error webcam_failure(const std::string& device, const char* doing, int code);

}  // namespace telehug
