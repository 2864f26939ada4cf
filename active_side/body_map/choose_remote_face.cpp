// SPDX-License-Identifier: Apache-2.0
#include "body_map/choose_remote_face.hpp"

#include <algorithm>

namespace telehug {
namespace {

bool near_an_end(double position, double length, double share) {
  return std::min(position, length - position) < share * length;
}

bool in_corner(const cv::Rect2d& face, ImageSize picture, double share) {
  return near_an_end(face.x + face.width / 2, picture.width_px, share) &&
         near_an_end(face.y + face.height / 2, picture.height_px, share);
}

}  // namespace

std::optional<FoundFace> choose_remote_face(const FoundFaces& faces, ImageSize picture, const RemoteFaceRules& rules) {
  std::optional<FoundFace> largest;
  for (const FoundFace& face : faces) {
    if (face.box.height < rules.min_height_share * picture.height_px ||
        in_corner(face.box, picture, rules.corner_share)) {
      continue;
    }
    if (!largest || face.box.height > largest->box.height) {
      largest = face;
    }
  }
  return largest;
}

}  // namespace telehug
