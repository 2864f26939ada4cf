// SPDX-License-Identifier: Apache-2.0
#include "calibration/border_choice.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace telehug {
namespace {

// Half the difference of two sums of squares: the second is e^-4.5 times as likely as the first, three standard
// deviations.
constexpr double clear_margin = 4.5;
// What the right edge adds to half the sum of squares: half a unit for each of its points, and what they bend beyond
// the model. An edge that adds more contradicts the touches.
constexpr double cost_per_point = 1;
constexpr double most_besides = 15;

struct Trial {
  std::size_t candidate;
  RigObservations observations;
  RigSolution solution;
};

double level_px(const BorderCandidate& candidate) {
  double sum = 0;
  for (const BorderObservation& point : candidate.points)
    sum += point.image.v_px;
  return sum / static_cast<double>(candidate.points.size());
}

}  // namespace

Result<BorderChosen> solve_with_border(RigObservations observations, const std::vector<BorderCandidate>& candidates,
                                       const RigSolverOptions& options) {
  observations.border.clear();
  auto without = solve_rig(observations, options);
  if (!without) return without.error();
  RigSolverOptions known = options;
  known.orientation = without->model.camera.orientation();

  std::vector<Trial> trials;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (candidates[i].points.empty()) continue;
    Trial trial{i, observations, *without};
    trial.observations.border = candidates[i].points;
    const double most =
        without->cost + cost_per_point * static_cast<double>(trial.observations.border.size()) + most_besides;
    if (auto solution = solve_rig(trial.observations, known); solution && solution->cost <= most) {
      trial.solution = *std::move(solution);
      trials.push_back(std::move(trial));
    }
  }
  std::sort(trials.begin(), trials.end(),
            [](const Trial& a, const Trial& b) { return a.solution.cost < b.solution.cost; });
  if (trials.empty()) return BorderChosen{{observations, *std::move(without)}, std::nullopt, false};

  Trial& best = trials.front();
  const bool clear = trials.size() == 1 || trials[1].solution.cost - best.solution.cost >= clear_margin;
  if (!clear) {
    const double apart_px = std::abs(level_px(candidates[best.candidate]) - level_px(candidates[trials[1].candidate]));
    for (BorderObservation& point : best.observations.border)
      point.sigma_px = std::max(point.sigma_px, apart_px);
    auto solution = solve_rig(best.observations, known);
    if (!solution) return solution.error();
    best.solution = *std::move(solution);
  }
  return BorderChosen{{std::move(best.observations), std::move(best.solution)}, best.candidate, clear};
}

}  // namespace telehug
