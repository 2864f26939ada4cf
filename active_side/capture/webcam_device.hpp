// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "common/result.hpp"

namespace telehug {

// The first webcam under /dev/v4l/by-id, in order of names; else /dev/video0.
std::string first_webcam_device();

// Why `device` could not be used, with what to do about it. `doing`: what was tried, as in "can't be opened"; `code`: a
// negative errno.
Error webcam_failure(const std::string& device, const char* doing, int code);

}  // namespace telehug
