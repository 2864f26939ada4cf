// SPDX-License-Identifier: Apache-2.0
#include "calibration/rig_solver.hpp"

#include <fmt/core.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "calibration/rig_least_squares.hpp"
#include "calibration/rig_residuals.hpp"

namespace telehug {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
// Beyond this many standard deviations a touch is worth leaving out to see what the others say, and beyond the second
// it contradicts them: among ten good touches one in 4e4 rigs lies as far out.
constexpr double suspicious_sd = 4;
constexpr double contradicting_sd = 5;
constexpr std::size_t least_touches_to_leave_one_out = 5;

std::string fault_of(const RigObservations& o) {
  if (!(o.screen.width_mm > 0) || !(o.screen.height_mm > 0)) return "the screen's size is not known";
  if (o.image.width_px <= 0 || o.image.height_px <= 0) return "the picture's size is not known";
  const auto used = std::count_if(o.touches.begin(), o.touches.end(), [](const auto& t) { return !t.left_out; });
  if (static_cast<std::size_t>(used) + o.marks.size() < 2) {
    return fmt::format("{} touches are too few: touch two points at least", used);
  }
  const auto impossible = [](const PointObservation& p) {
    return !std::isfinite(p.screen.x_mm) || !std::isfinite(p.screen.y_mm) || !std::isfinite(p.image.u_px) ||
           !std::isfinite(p.image.v_px) || !(p.sigma_u_px > 0) || !(p.sigma_v_px > 0);
  };
  for (std::size_t i = 0; i < o.touches.size(); ++i) {
    if (impossible(o.touches[i])) return fmt::format("calibration touch {} is not a point: touch it again", i + 1);
  }
  if (std::any_of(o.marks.begin(), o.marks.end(), impossible)) return "a mark on the screen is not a point";
  if (std::any_of(o.border.begin(), o.border.end(), [](const BorderObservation& b) {
        return !std::isfinite(b.image.u_px) || !std::isfinite(b.image.v_px) || !(b.sigma_px > 0);
      })) {
    return "a point of the screen's border is not a point";
  }
  return "";
}

// Rigs from which the solver begins: the priors' mean, and others a standard deviation or more away from it in those
// parameters that bend the equations most.
std::vector<RigParameters> starts(const RigPriors& priors) {
  std::vector<RigParameters> found;
  for (const double z : {0.4, 1.0, 1.8}) {
    for (const double f : {-1.2, 0.0, 1.5}) {
      for (const double y : {-1.5, 0.0, 1.2}) {
        RigParameters start = priors.mean;
        start[RigParameter::z0_mm] *= z;
        start[RigParameter::focal_px] += f * priors.sd[RigParameter::focal_px];
        start[RigParameter::y0_mm] += y * priors.sd[RigParameter::y0_mm];
        found.push_back(start);
      }
    }
  }
  return found;
}

struct Fit {
  RigParameters parameters{};
  PictureOrientation orientation;
  double cost = infinite;
};

// Noise far below a pixel makes a narrow valley of the cost, so it is approached in steps: first with noise of some
// pixels and without the robust loss, then with it and less and less noise.
constexpr double coarse_px = 4;

RigDescent coarse(const RigLeastSquares& problem) {
  // The wrong orientations, in which nothing fits, would take many more steps.
  constexpr int steps = 10;
  return {std::max(1.0, coarse_px / problem.least_sigma_px()), RigLoss::squares, steps};
}

Fit descend(const RigLeastSquares& problem, Fit fit) {
  constexpr double step = 4;
  for (double scale = coarse(problem).sigma_scale; scale > 1; scale /= step)
    fit.parameters = problem.minimise(fit.parameters, {.sigma_scale = scale});
  fit.parameters = problem.minimise(fit.parameters, {});
  fit.cost = problem.cost(fit.parameters, {});
  return fit;
}

// The best ways down for one orientation, each to the bottom of its coarse valley.
std::vector<Fit> coarse_fits(const RigLeastSquares& problem, const RigPriors& priors, PictureOrientation orientation) {
  constexpr std::size_t tried = 3;
  const RigDescent how = coarse(problem);
  std::vector<Fit> fits;
  for (const RigParameters& start : starts(priors))
    fits.push_back({start, orientation, problem.cost(start, how)});
  std::sort(fits.begin(), fits.end(), [](const Fit& a, const Fit& b) { return a.cost < b.cost; });
  fits.resize(tried);
  std::erase_if(fits, [](const Fit& fit) { return !std::isfinite(fit.cost); });
  for (Fit& fit : fits) {
    fit.parameters = problem.minimise(fit.parameters, how);
    fit.cost = problem.cost(fit.parameters, how);
  }
  return fits;
}

Fit best_fit(const RigObservations& observations, const RigPriors& priors,
             const std::vector<PictureOrientation>& orientations) {
  // What one bad touch, 40 px off, adds to the coarse cost of the right rig.
  constexpr double bad_touch_cost = 60;
  std::vector<Fit> fits;
  for (const PictureOrientation& orientation : orientations) {
    const auto more = coarse_fits(RigLeastSquares(observations, priors, orientation), priors, orientation);
    fits.insert(fits.end(), more.begin(), more.end());
  }
  double least = infinite;
  for (const Fit& fit : fits)
    least = std::min(least, fit.cost);
  Fit best;
  for (const Fit& fit : fits) {
    if (fit.cost > least + bad_touch_cost) continue;
    const Fit bottom = descend(RigLeastSquares(observations, priors, fit.orientation), fit);
    if (bottom.cost < best.cost) best = bottom;
  }
  return best;
}

double standardised(const RigModel& model, const PointObservation& touch) {
  const auto residual = touch_residual(model, touch);
  return residual ? std::hypot(residual->u_px / touch.sigma_u_px, residual->v_px / touch.sigma_v_px) : infinite;
}

RigObservations used_of(const RigObservations& all) {
  RigObservations used = all;
  std::erase_if(used.touches, [](const PointObservation& touch) { return touch.left_out; });
  return used;
}

// Of the used touch with this index, the index among all.
std::size_t index_among(const RigObservations& all, std::size_t used) {
  for (std::size_t i = 0;; ++i) {
    if (!all.touches[i].left_out && used-- == 0) return i;
  }
}

RigObservations without(const RigObservations& all, std::size_t touch) {
  RigObservations rest = all;
  rest.touches.erase(rest.touches.begin() + static_cast<std::ptrdiff_t>(touch));
  return rest;
}

struct Exclusion {
  std::size_t touch;
  Fit fit;
};

// The touch without which the others agree best, if it then contradicts them.
std::optional<Exclusion> find_bad_touch(const RigObservations& all, const RigPriors& priors, const Fit& fit) {
  if (all.touches.size() < least_touches_to_leave_one_out) return std::nullopt;
  const RigModel model = make_rig_model(fit.parameters, all.image, fit.orientation);
  const bool suspicious = std::any_of(all.touches.begin(), all.touches.end(), [&](const PointObservation& touch) {
    return standardised(model, touch) > suspicious_sd;
  });
  if (!suspicious) return std::nullopt;
  std::optional<Exclusion> best;
  for (std::size_t i = 0; i < all.touches.size(); ++i) {
    const Fit without_it = best_fit(without(all, i), priors, {fit.orientation});
    if (!best || without_it.cost < best->fit.cost) best = Exclusion{i, without_it};
  }
  const RigModel others = make_rig_model(best->fit.parameters, all.image, fit.orientation);
  if (standardised(others, all.touches[best->touch]) < contradicting_sd) return std::nullopt;
  return best;
}

RigSolution describe(const RigObservations& all, const RigLeastSquares& used, const RigParameters& parameters,
                     PictureOrientation orientation) {
  RigSolution solution{make_rig_model(parameters, all.image, orientation), parameters, {}, {}, {}, 0, 0, 0};
  solution.covariance = used.covariance(parameters);
  solution.reduced_chi2 = used.reduced_chi2(parameters);
  for (const PointObservation& touch : all.touches) {
    TouchResidual residual;
    residual.standardised = standardised(solution.model, touch);
    if (const auto placed = touched_point(solution.model, touch)) {
      residual.error_mm = {placed->x_mm - touch.screen.x_mm, placed->y_mm - touch.screen.y_mm};
    } else {
      residual.error_mm = {infinite, infinite};
    }
    solution.touches.push_back(residual);
  }
  double squares = 0;
  for (const BorderObservation& border : all.border) {
    const double residual = border_residual(solution.model, all.screen.height_mm, border).value_or(infinite);
    squares += residual * residual;
  }
  if (!all.border.empty()) solution.border_rms_px = std::sqrt(squares / static_cast<double>(all.border.size()));
  return solution;
}

}  // namespace

RigModel make_rig_model(const RigParameters& p, ImageSize image, PictureOrientation orientation) {
  using P = RigParameter;
  return {RigCamera({p[P::focal_px],
                     p[P::k1],
                     {p[P::x0_mm], p[P::y0_mm], p[P::z0_mm]},
                     p[P::pitch_deg],
                     p[P::yaw_deg],
                     p[P::roll_deg]},
                    image, orientation),
          p[P::contact_radius_mm]};
}

Result<RigSolution> solve_rig(const RigObservations& observations, const RigSolverOptions& options) {
  if (const std::string fault = fault_of(observations); !fault.empty()) return Error{fault};
  const RigPriors priors = options.priors.value_or(usual_rigs(observations.screen, observations.image));

  std::vector<PictureOrientation> orientations{{false, false}, {true, false}, {true, true}, {false, true}};
  if (options.orientation) orientations = {*options.orientation};
  const RigObservations used = used_of(observations);
  const Fit best = best_fit(used, priors, orientations);
  if (!std::isfinite(best.cost)) {
    return Error{"no camera on top of this screen sees the touches like this: check the screen's size, touch again"};
  }
  const auto bad = options.leave_out_bad_touch ? find_bad_touch(used, priors, best) : std::nullopt;
  const RigLeastSquares problem(bad ? without(used, bad->touch) : used, priors, best.orientation);
  RigSolution solution = describe(observations, problem, bad ? bad->fit.parameters : best.parameters, best.orientation);
  if (bad) solution.bad_touch = index_among(observations, bad->touch);
  solution.cost = best.cost;
  return solution;
}

}  // namespace telehug
