// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "body_map/face_finder.hpp"
#include "common/units.hpp"

namespace telehug {

struct RemoteFaceRules {
  double min_height_share = 0.07;  // a face lower than this share of the picture is no one to touch
  double corner_share = 0.20;      // a face whose centre is this near to a corner, on both axes, is the own picture
};

// The remote person among all found faces: the largest that is neither too small nor in a corner, where video chats put
// the user's own picture (thesis). None if there is no such face.
std::optional<FoundFace> choose_remote_face(const FoundFaces& faces, ImageSize picture,
                                            const RemoteFaceRules& rules = {});

}  // namespace telehug
