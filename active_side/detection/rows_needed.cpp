// SPDX-License-Identifier: Apache-2.0
#include "detection/rows_needed.hpp"

#include <algorithm>
#include <cmath>

#include "detection/make_detector.hpp"

namespace telehug {
namespace {

// Rows in front of the border strip, of 720: what is seen there of a finger on its way to the border. 150 take the
// sides of fingers up to 80 px wide that touch close to the screen's edge.
constexpr double in_front_of_strip_px = 150;

}  // namespace

RowRange rows_needed(const Calibration& calibration) {
  const Calibration turned = upright(calibration);
  const BorderCurve border = border_curve(turned);
  double highest_px = border.v_at(0);
  for (int u = 1; u < turned.image.width_px; ++u)
    highest_px = std::min(highest_px, border.v_at(u));
  const BorderStrip::Layout strip(border, turned.image);
  const double first_px = highest_px + strip.offset_px(BorderStrip::rails - 1) - in_front_of_strip_px * strip.scale;
  const RowRange rows =
      RowRange{static_cast<int>(std::floor(first_px)), turned.image.height_px}.within(turned.image.height_px);
  return is_upside_down(calibration) ? rows.flipped(turned.image.height_px) : rows;
}

}  // namespace telehug
