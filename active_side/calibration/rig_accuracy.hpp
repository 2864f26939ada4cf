// SPDX-License-Identifier: Apache-2.0
//
// How exact a solved rig is, before anybody has touched it: the parameters' covariance and the noise of a tip, carried
// to the screen to first order.
#pragma once

#include <optional>
#include <vector>

#include "calibration/rig_solver.hpp"

namespace telehug {

// Standard deviations of the tip that a detector finds.
struct TipNoise {
  double sigma_u_px = 0.3;
  double sigma_v_px = 0.3;
  // Of the contact radius from finger to finger and touch to touch; 4.5 mm stand for 0.5 mm on the screen.
  double contact_radius_sd_mm = 0;
};

// Standard deviations of a touch's place.
struct PredictedError {
  double horizontal_mm = 0;
  double vertical_mm = 0;
};

// Nothing where the camera can't see.
[[nodiscard]] std::optional<PredictedError> predicted_error_mm(const RigSolution& solution, const ScreenPoint& contact,
                                                               const TipNoise& noise = {});

struct ErrorAt {
  ScreenPoint screen;
  PredictedError error;
};

// The centres of columns x rows equal fields of the screen, row by row from the top left, those that the camera sees.
[[nodiscard]] std::vector<ErrorAt> error_map(const RigSolution& solution, const ScreenSize& screen, int columns,
                                             int rows, const TipNoise& noise = {});

// The part of the screen in which a touch's tip is in the picture.
struct Reach {
  std::vector<ScreenPoint> outline;  // a polygon on the screen, clockwise from its bottom left; empty: nothing is seen
  double top_mm = 0;                 // the highest point
  double left_mm = 0;                // at the bottom edge
  double right_mm = 0;
};

[[nodiscard]] Reach reach(const RigModel& model, const ScreenSize& screen);

}  // namespace telehug
