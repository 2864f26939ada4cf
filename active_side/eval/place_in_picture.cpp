// SPDX-License-Identifier: Apache-2.0
#include "eval/place_in_picture.hpp"

#include <cmath>
#include <variant>

namespace telehug {
namespace {

// The thesis' model leads from the picture to the screen only. The longer the finger, the higher the place, and at one
// length places lie as far apart as columns do.
std::optional<ImagePoint> thesis_place(const ThesisTouchModel& model, const Calibration& calibration,
                                       const ScreenPoint& place) {
  double low_px = 0;
  double high_px = calibration.image.height_px;
  constexpr int halvings = 40;
  for (int i = 0; i < halvings; ++i) {
    const double length_px = (low_px + high_px) / 2;
    const auto point = model.screen_point(length_px, 0);
    (point && point->y_mm > place.y_mm ? low_px : high_px) = length_px;
  }
  const auto at_centre = model.screen_point(low_px, 0);
  const auto beside = model.screen_point(low_px, 1);
  constexpr double met_mm = 1;
  if (!at_centre || !beside || std::abs(at_centre->y_mm - place.y_mm) > met_mm) return std::nullopt;
  const double column_px = (place.x_mm - at_centre->x_mm) / (beside->x_mm - at_centre->x_mm);
  const double u_px = column_px + 0.5 * (calibration.image.width_px - 1);
  return ImagePoint{u_px, calibration.border.v_at(u_px) + low_px};
}

}  // namespace

std::optional<ImagePoint> place_in_picture(const Calibration& calibration, const ScreenPoint& place) {
  if (const auto* rig = std::get_if<RigCalibration>(&calibration.solved)) {
    return rig->solution.model.camera.project(place);
  }
  return thesis_place(std::get<ThesisCalibration>(calibration.solved).model, calibration, place);
}

}  // namespace telehug
