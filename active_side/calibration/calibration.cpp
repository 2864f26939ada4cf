// SPDX-License-Identifier: Apache-2.0
#include "calibration/calibration.hpp"

#include "calibration/rig_residuals.hpp"

namespace telehug {

TouchModel Calibration::model() const {
  if (const auto* rig = std::get_if<RigCalibration>(&solved)) return rig->solution.model;
  return std::get<ThesisCalibration>(solved).model;
}

const char* Calibration::model_name() const noexcept {
  return std::holds_alternative<RigCalibration>(solved) ? "default" : "thesis";
}

double Calibration::camera_below_top_mm() const noexcept {
  if (const auto* rig = std::get_if<RigCalibration>(&solved)) return rig->solution.model.camera.position_mm().y_mm;
  return std::get_if<ThesisCalibration>(&solved)->model.camera_below_top_mm();
}

BorderCurve border_curve(const Calibration& calibration) {
  const auto* const rig = std::get_if<RigCalibration>(&calibration.solved);
  if (rig == nullptr) return {calibration.border, calibration.image};
  return {rig->solution.model.camera, calibration.screen};
}

BorderLine border_line(const RigCamera& camera, const ScreenSize& screen) {
  constexpr int columns = 64;
  double n = 0, su = 0, sv = 0, suu = 0, suv = 0;
  for (int i = 0; i < columns; ++i) {
    const double u = (i + 0.5) / columns * camera.image().width_px;
    const auto v = border_row(camera, screen.height_mm, u);
    if (!v) continue;
    n += 1, su += u, sv += *v, suu += u * u, suv += u * *v;
  }
  const double determinant = n * suu - su * su;
  const double slope = determinant > 0 ? (n * suv - su * sv) / determinant : 0;
  return {n > 0 ? (sv - slope * su) / n : 0, slope};
}

bool is_upside_down(const Calibration& calibration) noexcept {
  const auto* const rig = std::get_if<RigCalibration>(&calibration.solved);
  return rig != nullptr && rig->solution.model.camera.orientation().top_bottom_exchanged;
}

Calibration upright(const Calibration& calibration) {
  Calibration turned = calibration;
  if (!is_upside_down(calibration)) return turned;
  RigCamera& camera = std::get<RigCalibration>(turned.solved).solution.model.camera;
  PictureOrientation orientation = camera.orientation();
  orientation.top_bottom_exchanged = false;
  camera = RigCamera(camera.parameters(), camera.image(), orientation);
  turned.border = {calibration.image.height_px - 1 - calibration.border.v0_px, -calibration.border.slope};
  return turned;
}

}  // namespace telehug
