// SPDX-License-Identifier: Apache-2.0
#include "detection/rows_needed.hpp"

#include <algorithm>
#include <cmath>

#include "finger/border_strip.hpp"

namespace telehug {
namespace {

// Rows in front of the border strip, of 720: what is seen there of a finger on its way to the border. 150 take the
// sides of fingers up to 80 px wide that touch close to the screen's edge.
constexpr double in_front_of_strip_px = 150;

}  // namespace

RowRange rows_needed(const BorderCurve& border, ImageSize image) {
  double highest_px = border.v_at(0);
  for (int u = 1; u < image.width_px; ++u)
    highest_px = std::min(highest_px, border.v_at(u));
  const BorderStrip::Layout strip(border, image);
  const double first_px = highest_px + strip.offset_px(BorderStrip::rails - 1) - in_front_of_strip_px * strip.scale;
  return RowRange{static_cast<int>(std::floor(first_px)), image.height_px}.within(image.height_px);
}

RowRange rows_needed(const Calibration& calibration) {
  const RowRange rows = rows_needed(border_curve(upright(calibration)), calibration.image);
  return is_upside_down(calibration) ? rows.flipped(calibration.image.height_px) : rows;
}

}  // namespace telehug
