// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <optional>

#include "face/face_finder.hpp"

namespace telehug {

inline std::optional<FoundFace> largest_face(const FoundFaces& faces) {
  const auto largest = std::ranges::max_element(faces, {}, [](const FoundFace& face) { return face.box.height; });
  return largest == faces.end() ? std::nullopt : std::optional(*largest);
}

}  // namespace telehug
