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
  Timestamp seen;             // when the picture that shows the face was taken
  ScreenRect face;            // hairline to chin
  ScreenRect grid;            // the whole grid, uncut to the sides; its bottom is the picture's bottom
  GridShape shape;            // columns = 5
  double box_side_mm = 0;     // face height / 2
};

}  // namespace telehug
