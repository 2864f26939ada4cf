// SPDX-License-Identifier: Apache-2.0
#include "detection/rows_needed.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <variant>

#include "finger/border_strip.hpp"
#include "finger/overview.hpp"
#include "finger/picture_scale.hpp"

namespace telehug {
namespace {

// Rows in front of the border strip, of 720: what is seen there of a finger on its way to the border. 150 take the
// sides of fingers up to 80 px wide that touch close to the screen's edge.
constexpr double in_front_of_strip_px = 150;

}  // namespace

RowRange rows_needed(const BorderCurve& border, ImageSize image, double px_per_mm) {
  double highest_px = border.v_at(0);
  for (int u = 1; u < image.width_px; ++u)
    highest_px = std::min(highest_px, border.v_at(u));
  const BorderStrip::Layout strip(border, image);
  const double first_px = highest_px + strip.offset_px(BorderStrip::rails - 1) - in_front_of_strip_px * strip.scale;
  const int first = std::min(static_cast<int>(std::floor(first_px)), Overview::first_row_px(border, image, px_per_mm));
  return RowRange{first, image.height_px}.within(image.height_px);
}

RowRange rows_needed(const Calibration& calibration) {
  const Calibration turned = upright(calibration);
  const auto* const rig = std::get_if<RigCalibration>(&turned.solved);
  const auto camera = rig == nullptr ? std::nullopt : std::optional(rig->solution.model.camera);
  const BorderCurve border = border_curve(turned);
  const RowRange rows = rows_needed(border, calibration.image, px_per_mm_at_border(camera, border, calibration.image));
  return is_upside_down(calibration) ? rows.flipped(calibration.image.height_px) : rows;
}

}  // namespace telehug
