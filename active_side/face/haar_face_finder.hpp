// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "face/face_finder.hpp"

namespace telehug {

// Where distributions put haarcascade_frontalface_default.xml, most likely first (Debian: package opencv-data).
std::vector<std::filesystem::path> known_haar_cascades();

// OpenCV's frontal face cascade (Viola and Jones 2001), the thesis' detector. It sees upright, frontal, fairly lit
// faces. Fails if none of `paths` is a cascade; the first that exists is taken.
Result<std::unique_ptr<FaceFinder>> make_haar_face_finder(
    const std::vector<std::filesystem::path>& paths = known_haar_cascades());

}  // namespace telehug
