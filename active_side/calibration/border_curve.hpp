// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "calibration/border_line.hpp"
#include "calibration/rig_camera.hpp"
#include "common/units.hpp"

namespace telehug {

// The image of the screen's bottom edge as the lens bends it: its row for every column of the picture. The screen lies
// below it in the picture.
class BorderCurve {
 public:
  BorderCurve(const BorderLine& line, ImageSize image);
  // The edge is thought to go on straight beyond the screen's corners. Throws std::invalid_argument if the camera does
  // not see it.
  BorderCurve(const RigCamera& camera, const ScreenSize& screen);

  // The column is taken as the picture's nearest one.
  [[nodiscard]] double v_at(double u_px) const noexcept;
  [[nodiscard]] double slope_at(double u_px) const noexcept;

 private:
  std::vector<double> v_px_;
};

}  // namespace telehug
