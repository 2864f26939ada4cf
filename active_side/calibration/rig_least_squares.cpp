// SPDX-License-Identifier: Apache-2.0
#include "calibration/rig_least_squares.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "calibration/rig_residuals.hpp"
#include "calibration/rig_solver.hpp"

namespace telehug {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
// Cauchy's loss c^2 log(1 + s^2 / c^2) of a point's distance s in standard deviations: at c = 3 good points keep nearly
// all their weight, one 10 away has a tenth.
constexpr double cauchy_c2 = 9;

double loss(double s2, RigLoss kind) {
  return kind == RigLoss::squares ? s2 : cauchy_c2 * std::log1p(s2 / cauchy_c2);
}

double weight(double s2, RigLoss kind) {
  return kind == RigLoss::squares ? 1.0 : 1 / (1 + s2 / cauchy_c2);
}

}  // namespace

RigLeastSquares::RigLeastSquares(RigObservations observations, const RigPriors& priors, PictureOrientation orientation)
    : observations_(std::move(observations)),
      priors_(priors),
      orientation_(orientation),
      size_(static_cast<Eigen::Index>(2 * observations_.touches.size() + 2 * observations_.marks.size() +
                                      observations_.border.size())),
      pairs_(size_ - static_cast<Eigen::Index>(observations_.border.size())),
      least_sigma_px_(infinite) {
  for (const PointObservation& point : observations_.touches)
    least_sigma_px_ = std::min({least_sigma_px_, point.sigma_u_px, point.sigma_v_px});
  for (const PointObservation& point : observations_.marks)
    least_sigma_px_ = std::min({least_sigma_px_, point.sigma_u_px, point.sigma_v_px});
  for (const BorderObservation& border : observations_.border)
    least_sigma_px_ = std::min(least_sigma_px_, border.sigma_px);
}

RigLeastSquares::Vector RigLeastSquares::standardise(const RigParameters& parameters) const {
  Vector q;
  for (std::size_t i = 0; i < parameters.size(); ++i)
    q[static_cast<Eigen::Index>(i)] = (parameters[i] - priors_.mean[i]) / priors_.sd[i];
  return q;
}

RigParameters RigLeastSquares::parameters_at(const Vector& q) const {
  RigParameters parameters{};
  for (std::size_t i = 0; i < parameters.size(); ++i)
    parameters[i] = priors_.mean[i] + q[static_cast<Eigen::Index>(i)] * priors_.sd[i];
  return parameters;
}

bool RigLeastSquares::residuals(const Vector& q, Eigen::VectorXd& r) const {
  const RigParameters parameters = parameters_at(q);
  if (!(parameters[RigParameter::focal_px] > 0) || !(parameters[RigParameter::z0_mm] > 0)) return false;
  const RigModel model = make_rig_model(parameters, observations_.image, orientation_);
  r.resize(size_);
  Eigen::Index row = 0;
  const auto add = [&](const std::optional<ImagePoint>& residual, const PointObservation& point) {
    if (!residual) return false;
    r[row++] = residual->u_px / point.sigma_u_px;
    r[row++] = residual->v_px / point.sigma_v_px;
    return true;
  };
  for (const PointObservation& touch : observations_.touches) {
    if (!add(touch_residual(model, touch), touch)) return false;
  }
  for (const PointObservation& mark : observations_.marks) {
    if (!add(mark_residual(model, mark), mark)) return false;
  }
  for (const BorderObservation& border : observations_.border) {
    const auto residual = border_residual(model, observations_.screen.height_mm, border);
    if (!residual) return false;
    r[row++] = *residual / border.sigma_px;
  }
  return r.allFinite();
}

bool RigLeastSquares::jacobian(const Vector& q, Jacobian& j) const {
  constexpr double step = 1e-4;  // of the priors' standard deviations; the second order cancels
  j.resize(size_, RigParameter::count);
  Eigen::VectorXd ahead, behind;
  for (Eigen::Index i = 0; i < q.size(); ++i) {
    Vector moved = q;
    moved[i] = q[i] + step;
    if (!residuals(moved, ahead)) return false;
    moved[i] = q[i] - step;
    if (!residuals(moved, behind)) return false;
    j.col(i) = (ahead - behind) / (2 * step);
  }
  return true;
}

double RigLeastSquares::cost_of(const Vector& q, const Eigen::VectorXd& r, const RigDescent& how) const {
  const double scale2 = how.sigma_scale * how.sigma_scale;
  double sum = q.squaredNorm();
  for (Eigen::Index i = 0; i < pairs_; i += 2)
    sum += loss((r[i] * r[i] + r[i + 1] * r[i + 1]) / scale2, how.loss);
  for (Eigen::Index i = pairs_; i < size_; ++i)
    sum += loss(r[i] * r[i] / scale2, how.loss);
  return 0.5 * sum;
}

Eigen::VectorXd RigLeastSquares::weights(const Eigen::VectorXd& r, const RigDescent& how) const {
  const double scale2 = how.sigma_scale * how.sigma_scale;
  Eigen::VectorXd w(size_);
  for (Eigen::Index i = 0; i < pairs_; i += 2)
    w[i] = w[i + 1] = weight((r[i] * r[i] + r[i + 1] * r[i + 1]) / scale2, how.loss) / scale2;
  for (Eigen::Index i = pairs_; i < size_; ++i)
    w[i] = weight(r[i] * r[i] / scale2, how.loss) / scale2;
  return w;
}

RigParameters RigLeastSquares::minimise(const RigParameters& start, const RigDescent& how) const {
  constexpr double least_gain = 1e-10;  // of the cost
  Vector q = standardise(start);
  Eigen::VectorXd r, r_next;
  Jacobian j;
  if (!residuals(q, r)) return start;
  double cost = cost_of(q, r, how);
  double damping = 1e-3;
  for (int step = 0; step < how.most_steps && jacobian(q, j); ++step) {
    const Eigen::VectorXd w = weights(r, how);
    const Matrix normal = j.transpose() * w.asDiagonal() * j + Matrix::Identity();
    const Vector gradient = j.transpose() * w.cwiseProduct(r) + q;
    bool moved = false;
    double gain = 0;
    while (!moved && damping < 1e12) {
      Matrix damped = normal;
      damped.diagonal() *= 1 + damping;
      const Vector next = q - damped.ldlt().solve(gradient);
      const bool visible = residuals(next, r_next);
      const double next_cost = visible ? cost_of(next, r_next, how) : infinite;
      if (next_cost < cost) {
        gain = cost - next_cost;
        q = next;
        r.swap(r_next);
        cost = next_cost;
        damping = std::max(damping / 10, 1e-12);
        moved = true;
      } else {
        damping *= 10;
      }
    }
    if (!moved || gain <= least_gain * cost) break;
  }
  return parameters_at(q);
}

double RigLeastSquares::cost(const RigParameters& parameters, const RigDescent& how) const {
  const Vector q = standardise(parameters);
  Eigen::VectorXd r;
  return residuals(q, r) ? cost_of(q, r, how) : infinite;
}

RigCovariance RigLeastSquares::covariance(const RigParameters& parameters) const {
  const Vector q = standardise(parameters);
  Eigen::VectorXd r;
  Jacobian j;
  RigCovariance covariance{};
  if (!residuals(q, r) || !jacobian(q, j)) {
    for (std::size_t i = 0; i < covariance.size(); ++i)
      covariance[i][i] = infinite;
    return covariance;
  }
  const Eigen::VectorXd w = weights(r, {});
  const Matrix normal = j.transpose() * w.asDiagonal() * j + Matrix::Identity();
  const Matrix inverse = normal.ldlt().solve(Matrix::Identity());
  for (std::size_t i = 0; i < covariance.size(); ++i) {
    for (std::size_t k = 0; k < covariance.size(); ++k) {
      covariance[i][k] =
          inverse(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) * priors_.sd[i] * priors_.sd[k];
    }
  }
  return covariance;
}

double RigLeastSquares::reduced_chi2(const RigParameters& parameters) const {
  return 2 * cost(parameters, {.loss = RigLoss::squares}) / static_cast<double>(std::max<Eigen::Index>(size_, 1));
}

}  // namespace telehug
