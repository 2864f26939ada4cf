// SPDX-License-Identifier: Apache-2.0
#include "safety/muted_place.hpp"

#include <cmath>

namespace telehug {
namespace {

bool is_muted(BodyPoint place, const MutedBoxes& muted) {
  const double column = std::floor(place.x_fh / standard_box_side_fh + standard_columns / 2.0);
  const double row = std::floor(place.y_fh / standard_box_side_fh);
  const bool inside = column >= 0 && column < standard_columns && row >= 0 && row < standard_rows;  // false for NaN
  return inside && muted.test(static_cast<std::size_t>(row) * standard_columns + static_cast<std::size_t>(column) + 1);
}

}  // namespace

bool is_muted(const Contact& contact, const MutedBoxes& muted) {
  const bool standard = contact.grid.columns == standard_columns;
  if (standard && contact.box < muted.size() && muted.test(contact.box)) return true;
  return is_muted(contact.body, muted);
}

}  // namespace telehug
