// SPDX-License-Identifier: Apache-2.0
#include "calibration/consistent_touches.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include "calibration/rig_residuals.hpp"
#include "calibration/rig_solver.hpp"

namespace telehug {
namespace {

constexpr std::size_t least_touches = 4;
constexpr std::size_t enough_marks = 5;
constexpr std::size_t enough_touches = 2;  // to tell more than the marks alone
// Distances from where the solution of a triple, and then of all that agree with it, sees a touch. A triple tells
// little of what lies far beside it.
constexpr double near_triple_px = 25;  // in pictures 1280 px wide
constexpr double agrees_px = 4;
constexpr double agrees_sd = 5;
constexpr double agrees_with_marks_sd = 3;  // marks place the camera better than a few touches do

struct Consensus {
  std::vector<std::size_t> touches;
  double cost = std::numeric_limits<double>::infinity();

  [[nodiscard]] bool is_better_than(const Consensus& other) const {
    if (touches.size() != other.touches.size()) return touches.size() > other.touches.size();
    return cost < other.cost;
  }
};

class Search {
 public:
  explicit Search(const RigObservations& seen) : seen_(seen), scale_(seen.image.width_px / 1280.0) {}

  [[nodiscard]] std::vector<std::size_t> agreeing_with_marks() const {
    const auto solved = solve({});
    if (!solved) return {};
    std::vector<std::size_t> agreeing = near(solved->model, agrees_px * scale_, agrees_with_marks_sd);
    // Few marks tell little of what lies far beside them: what agrees with them and with these touches does, too.
    while (agreeing.size() >= enough_touches && agreeing.size() < seen_.touches.size()) {
      const auto better = solve(agreeing);
      if (!better) break;
      std::vector<std::size_t> more = near(better->model, agrees_px * scale_, agrees_with_marks_sd);
      if (more.size() <= agreeing.size()) break;
      agreeing = std::move(more);
    }
    return agreeing;
  }

  [[nodiscard]] std::optional<Consensus> consensus(const std::vector<std::size_t>& sample) const {
    auto solved = solve(sample);
    if (!solved) return std::nullopt;
    std::vector<std::size_t> agreeing = near(solved->model, near_triple_px * scale_, 0);
    if (agreeing.size() < sample.size()) return std::nullopt;
    solved = solve(agreeing);
    if (!solved) return std::nullopt;
    agreeing = near(solved->model, agrees_px * scale_, agrees_sd);
    return Consensus{agreeing, solved->cost};
  }

 private:
  [[nodiscard]] std::optional<RigSolution> solve(const std::vector<std::size_t>& touches) const {
    RigObservations some{seen_.screen, seen_.image, {}, seen_.marks, {}};
    for (const std::size_t i : touches) {
      some.touches.push_back(seen_.touches[i]);
      some.touches.back().left_out = false;
    }
    auto solved = solve_rig(some, {std::nullopt, std::nullopt, false});
    return solved ? std::optional(*std::move(solved)) : std::nullopt;
  }

  [[nodiscard]] std::vector<std::size_t> near(const RigModel& model, double limit_px, double limit_sd) const {
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < seen_.touches.size(); ++i) {
      const PointObservation& touch = seen_.touches[i];
      const auto residual = touch_residual(model, touch);
      if (!residual) continue;
      if (std::abs(residual->u_px) <= limit_px + limit_sd * touch.sigma_u_px &&
          std::abs(residual->v_px) <= limit_px + limit_sd * touch.sigma_v_px) {
        found.push_back(i);
      }
    }
    return found;
  }

  const RigObservations& seen_;
  double scale_;
};

}  // namespace

std::vector<std::size_t> consistent_touches(const RigObservations& seen) {
  const std::size_t n = seen.touches.size();
  std::vector<std::size_t> all(n);
  std::iota(all.begin(), all.end(), std::size_t{0});
  const Search search(seen);
  if (seen.marks.size() >= enough_marks) return search.agreeing_with_marks();
  if (n < least_touches) return all;
  Consensus best;
  if (const auto together = search.consensus(all)) best = *together;
  if (best.touches.size() == n) return all;
  for (std::size_t a = 0; a < n; ++a) {
    for (std::size_t b = a + 1; b < n; ++b) {
      for (std::size_t c = b + 1; c < n; ++c) {
        const auto found = search.consensus({a, b, c});
        if (found && found->is_better_than(best)) best = *found;
        if (best.touches.size() + 1 == n) return best.touches;
      }
    }
  }
  return best.touches;
}

}  // namespace telehug
