// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <variant>

#include "calibration/border_curve.hpp"
#include "calibration/border_line.hpp"
#include "calibration/rig_solver.hpp"
#include "calibration/touch_model.hpp"
#include "common/units.hpp"

namespace telehug {

struct ThesisCalibration {
  std::array<MeasuredTouch, 2> touches;
  ThesisTouchModel model;  // solved from the screen and the touches
};

struct RigCalibration {
  RigObservations observations;
  RigSolution solution;  // solved from the observations
};

// All that the active side needs to turn pictures of one camera into points on one screen.
struct Calibration {
  std::string camera;
  std::string date;  // ISO 8601, UTC
  ImageSize image;
  ScreenSize screen;  // its pixels are 0 if they are not known
  BorderLine border;
  std::variant<ThesisCalibration, RigCalibration> solved;

  [[nodiscard]] TouchModel model() const;
  [[nodiscard]] const char* model_name() const noexcept;  // "thesis" or "default"
  // Negative: above it.
  [[nodiscard]] double camera_below_top_mm() const noexcept;
};

// The image of the screen's bottom edge: as the lens bends it, if the calibration knows the lens.
[[nodiscard]] BorderCurve border_curve(const Calibration& calibration);

// The straight line nearest to the image of the screen's bottom edge, which a lens bends a little.
[[nodiscard]] BorderLine border_line(const RigCamera& camera, const ScreenSize& screen);

// The camera delivers its pictures with top and bottom exchanged: the screen lies above its border in them.
[[nodiscard]] bool is_upside_down(const Calibration& calibration) noexcept;

// The same calibration for pictures that were flipped about their middle row, if they have to be: the screen lies below
// its border in them.
[[nodiscard]] Calibration upright(const Calibration& calibration);

}  // namespace telehug
