// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "common/clock.hpp"
#include "common/messages.hpp"
#include "common/units.hpp"

namespace telehug {

// Where the remote person is on the screen, at one time: the face and the grid of boxes below it (thesis: Vitruvian
// grid; boxes are squares of half a face height, five per row, centred on the face, from the chin to the picture's
// bottom, the last row possibly cut).
struct BodyMap {
  std::uint32_t version = 0;  // new whenever the grid moves; 0: there is no map
  Timestamp seen;             // when the picture that shows the face was taken; before the last look: it is held
  ScreenRect face;            // hairline to chin
  ScreenRect grid;            // the whole grid, also where it reaches past the picture's sides
  ScreenRect visible;         // the part of the grid that lies in the picture: what is beside it is nobody's body
  GridShape shape;            // columns = 5
  double box_side_mm = 0;     // face height / 2
  bool mirrored = false;      // the picture shows the person as in a mirror: boxes are numbered from right to left
};

}  // namespace telehug
