// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>

#include "calibration/rig_observations.hpp"

namespace telehug {

enum class RigLoss { squares, cauchy };

struct RigDescent {
  double sigma_scale = 1;  // all observations' standard deviations are multiplied by this
  RigLoss loss = RigLoss::cauchy;
  int most_steps = 40;
};

// The cost of a rig's parameters and its minimum nearby. Parameters are counted in the priors' standard deviations from
// the priors' mean, so all have the same size and the priors are residuals like the others.
class RigLeastSquares {
 public:
  RigLeastSquares(RigObservations observations, const RigPriors& priors, PictureOrientation orientation);

  // Levenberg and Marquardt from `start`; never worse than it.
  [[nodiscard]] RigParameters minimise(const RigParameters& start, const RigDescent& how) const;
  // Infinite if the rig can't see an observation.
  [[nodiscard]] double cost(const RigParameters& parameters, const RigDescent& how) const;
  [[nodiscard]] RigCovariance covariance(const RigParameters& parameters) const;
  // The sum of squares over the number of observed coordinates: the priors count as many residuals as parameters.
  [[nodiscard]] double reduced_chi2(const RigParameters& parameters) const;
  // Of the most exact observation.
  [[nodiscard]] double least_sigma_px() const noexcept { return least_sigma_px_; }

 private:
  using Vector = Eigen::Matrix<double, RigParameter::count, 1>;
  using Matrix = Eigen::Matrix<double, RigParameter::count, RigParameter::count>;
  using Jacobian = Eigen::Matrix<double, Eigen::Dynamic, RigParameter::count>;

  [[nodiscard]] Vector standardise(const RigParameters& parameters) const;
  [[nodiscard]] RigParameters parameters_at(const Vector& q) const;
  // Standardised residuals with scale 1: two a touch, two a mark, one a border point. False: something can't be seen.
  bool residuals(const Vector& q, Eigen::VectorXd& r) const;
  bool jacobian(const Vector& q, Jacobian& j) const;
  [[nodiscard]] double cost_of(const Vector& q, const Eigen::VectorXd& r, const RigDescent& how) const;
  // A weight for each residual; a point's two coordinates share theirs.
  [[nodiscard]] Eigen::VectorXd weights(const Eigen::VectorXd& r, const RigDescent& how) const;

  RigObservations observations_;
  RigPriors priors_;
  PictureOrientation orientation_;
  Eigen::Index size_;
  Eigen::Index pairs_;  // residuals before this one come in pairs
  double least_sigma_px_;
};

}  // namespace telehug
