// SPDX-License-Identifier: Apache-2.0
//
// Solves a rig (camera and contact radius) from touches of known points, marks and the screen's bottom edge:
// least squares of the standardised residuals and of the parameters' standardised distances from the priors, by
// Levenberg and Marquardt. Residuals have Cauchy's loss, so that a bad touch loses its weight instead of bending the
// lens; with five touches and more a bad one is also found by leaving each out. The picture's orientation is tried in
// all four ways unless it is known.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "calibration/rig_model.hpp"
#include "calibration/rig_observations.hpp"
#include "common/result.hpp"

namespace telehug {

struct TouchResidual {
  ScreenPoint error_mm;     // where the solved model places the touch, minus where it was
  double standardised = 0;  // length of the image residual in standard deviations
};

struct RigSolution {
  RigModel model;
  RigParameters parameters{};
  RigCovariance covariance{};            // of the parameters, priors included
  std::vector<TouchResidual> touches;    // one a touch, excluded ones too
  std::optional<std::size_t> bad_touch;  // index of the touch that contradicts all others and was left out
  double cost = 0;                       // half the robust sum of squares, priors included: to compare two solutions
  double reduced_chi2 = 0;               // about 1 if the standard deviations are right
  double border_rms_px = 0;              // 0 without border observations
};

struct RigSolverOptions {
  std::optional<RigPriors> priors;                // else usual_rigs()
  std::optional<PictureOrientation> orientation;  // else detected
  bool leave_out_bad_touch = true;                // false: all touches count, as far as the robust loss lets them
};

[[nodiscard]] RigModel make_rig_model(const RigParameters& parameters, ImageSize image, PictureOrientation orientation);

// The error says which observation is impossible, or that no camera of the usual kind sees the touches like this.
// Needs two touches or marks.
Result<RigSolution> solve_rig(const RigObservations& observations, const RigSolverOptions& options = {});

}  // namespace telehug
