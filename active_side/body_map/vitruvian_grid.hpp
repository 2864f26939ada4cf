// SPDX-License-Identifier: Apache-2.0
//
// The thesis' grid of boxes over the remote person's body, after Vitruvius' proportions: shoulders 2.5 face heights
// wide, boxes of half a face height, so five a row.
#pragma once

#include <cstdint>
#include <optional>

#include "body_map/body_map.hpp"

namespace telehug {

inline constexpr std::uint16_t grid_columns = 5;
inline constexpr std::uint16_t max_grid_rows = 100;

// A touched box and the touched place on the body.
struct BoxHit {
  std::uint16_t box = 0;  // from 1, row by row, left to right; right to left if the picture is mirrored
  BodyPoint body;
};

// The map (still without version and time) of a face in the picture of the person, `view`, which may have any place and
// size. None if that leaves no box: the chin is at or below the picture's bottom, the grid lies beside it, the face has
// no height, a number is not finite, or the face is so small that the grid would have more than max_grid_rows.
std::optional<BodyMap> make_body_map(const ScreenRect& face, const ScreenRect& view, bool mirrored = false);

// The box under a point; none outside of the grid, beside the picture, or if there is no map. An edge between boxes
// belongs to the box right of it or below it, the grid's own right and bottom edge to the last column and row.
std::optional<BoxHit> box_at(const BodyMap& map, const ScreenPoint& point);

// The visible part of a box, which the picture's sides and bottom may cut. None if there is no box of that number or
// nothing of it is visible.
std::optional<ScreenRect> box_rect(const BodyMap& map, std::uint16_t box);

}  // namespace telehug
