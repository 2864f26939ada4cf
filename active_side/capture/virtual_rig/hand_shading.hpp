// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "capture/virtual_rig/hand_shape.hpp"
#include "capture/virtual_rig/linear_light.hpp"
#include "capture/virtual_rig/mesh_raster.hpp"
#include "capture/virtual_rig/shown_picture.hpp"

namespace telehug {

// A hand as the camera sees it, and as it sees it mirrored in the screen: one entry for each vertex of the mesh.
struct SeenHand {
  std::vector<RasterVertex> direct;
  std::vector<RasterVertex> mirrored;
};

// Puts a hand to a place and lights it: by the lamp, by the room as far as the screen does not stand before it, and by
// what the screen shows there.
void light_hand(const HandShape& shape, const FingerPlace& finger, const RoomLighting& lighting,
                const ShownPicture& shown, const PinholeCamera& camera, SeenHand& seen);

}  // namespace telehug
