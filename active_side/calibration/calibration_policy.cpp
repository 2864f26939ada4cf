// SPDX-License-Identifier: Apache-2.0
#include "calibration/calibration_policy.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "calibration/rig_accuracy.hpp"
#include "calibration/rig_residuals.hpp"

namespace telehug {
namespace {

// Standard deviations of a touch that is worth repeating, though the calibration may be good without it.
constexpr double worth_repeating_sd = 4;
// An exchange of two touches must explain this part of the robust cost to be believed.
constexpr double explained_part = 0.7;

double touch_rms_mm(const RigCalibration& calibration) {
  const RigSolution& solution = calibration.solution;
  double squares = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < solution.touches.size(); ++i) {
    if (solution.bad_touch == i || calibration.observations.touches[i].left_out) continue;
    const ScreenPoint& error = solution.touches[i].error_mm;
    squares += error.x_mm * error.x_mm + error.y_mm * error.y_mm;
    ++count;
  }
  return count > 0 ? std::sqrt(squares / static_cast<double>(count)) : 0;
}

std::size_t worst_touch(const RigSolution& solution) {
  if (solution.bad_touch) return *solution.bad_touch;
  const auto worst =
      std::max_element(solution.touches.begin(), solution.touches.end(),
                       [](const TouchResidual& a, const TouchResidual& b) { return a.standardised < b.standardised; });
  return static_cast<std::size_t>(worst - solution.touches.begin());
}

// Another dot that lies where the model of all other touches places this one.
std::optional<std::size_t> dot_at(const RigCalibration& calibration, std::size_t touch,
                                  const std::vector<ScreenPoint>& dots, double limit_mm) {
  const auto placed = touched_point(calibration.solution.model, calibration.observations.touches[touch]);
  if (!placed) return std::nullopt;
  std::optional<std::size_t> nearest;
  double nearest_mm = limit_mm;
  for (std::size_t i = 0; i < dots.size(); ++i) {
    const double apart_mm = std::hypot(placed->x_mm - dots[i].x_mm, placed->y_mm - dots[i].y_mm);
    if (apart_mm >= nearest_mm) continue;
    nearest = i;
    nearest_mm = apart_mm;
  }
  return nearest == touch ? std::nullopt : nearest;
}

// The two touches whose exchange makes all agree. One bad touch alone was not exchanged with another.
std::optional<std::pair<std::size_t, std::size_t>> exchanged_touches(const RigCalibration& calibration) {
  const auto bad = std::count_if(calibration.solution.touches.begin(), calibration.solution.touches.end(),
                                 [](const TouchResidual& touch) { return touch.standardised > worth_repeating_sd; });
  if (bad < 2) return std::nullopt;
  RigObservations all = calibration.observations;
  for (PointObservation& touch : all.touches)
    touch.left_out = false;
  const auto together = solve_rig(all, {std::nullopt, std::nullopt, false});
  if (!together) return std::nullopt;
  std::optional<std::pair<std::size_t, std::size_t>> best;
  double least = (1 - explained_part) * together->cost;
  for (std::size_t a = 0; a < all.touches.size(); ++a) {
    for (std::size_t b = a + 1; b < all.touches.size(); ++b) {
      RigObservations exchanged = all;
      std::swap(exchanged.touches[a].screen, exchanged.touches[b].screen);
      const auto solution = solve_rig(exchanged, {std::nullopt, std::nullopt, false});
      if (!solution || solution->cost >= least) continue;
      least = solution->cost;
      best = {a, b};
    }
  }
  return best;
}

void judge_touches(const RigCalibration& calibration, const std::vector<ScreenPoint>& dots,
                   const CalibrationLimits& limits, CalibrationVerdict& verdict) {
  const RigSolution& solution = calibration.solution;
  if (solution.touches.empty()) return;
  const std::size_t worst = worst_touch(solution);
  const double rms_mm = touch_rms_mm(calibration);
  if (rms_mm > limits.touch_rms_mm) {
    verdict.faults.push_back(fmt::format("the touches contradict each other by {:.1f} mm, more than {:.0f} mm", rms_mm,
                                         limits.touch_rms_mm));
  }
  if (verdict.good() && solution.touches[worst].standardised < worth_repeating_sd) return;
  verdict.repeat = worst;
  if (const auto two = exchanged_touches(calibration)) {
    verdict.exchanged = two;
    verdict.advice.push_back(fmt::format("touches {} and {} look exchanged: touch the dots in their order",
                                         two->first + 1, two->second + 1));
  } else if (const auto dot = dot_at(calibration, worst, dots, limits.same_dot_mm)) {
    verdict.looks_like = dot;
    verdict.advice.push_back(
        fmt::format("touch {} looks as if it were at dot {}: touch dot {} again", worst + 1, *dot + 1, worst + 1));
  } else {
    const ScreenPoint& error = solution.touches[worst].error_mm;
    verdict.advice.push_back(fmt::format("touch {} lies {:.1f} mm from where the others say: touch dot {} again",
                                         worst + 1, std::hypot(error.x_mm, error.y_mm), worst + 1));
  }
}

void judge_camera(const RigCalibration& calibration, const CalibrationLimits& limits, CalibrationVerdict& verdict) {
  constexpr std::array<const char*, RigParameter::count> what{"focal length of {:.0f} px",
                                                              "lens distortion of {:.2f}",
                                                              "place {:.0f} mm from the screen's left edge",
                                                              "place {:.0f} mm below the screen's top",
                                                              "distance of {:.0f} mm from the screen",
                                                              "pitch of {:.1f} degrees",
                                                              "yaw of {:.1f} degrees",
                                                              "roll of {:.1f} degrees",
                                                              "finger radius of {:.1f} mm"};
  const RigPriors priors = usual_rigs(calibration.observations.screen, calibration.observations.image);
  for (std::size_t i = 0; i < what.size(); ++i) {
    if (std::abs(calibration.solution.parameters[i] - priors.mean[i]) <= limits.parameter_sd * priors.sd[i]) continue;
    verdict.faults.push_back(
        "the camera would have a " + fmt::format(fmt::runtime(what[i]), calibration.solution.parameters[i]) +
        ", which no webcam on top of a monitor has: check the screen's size and the order of the touches");
  }
}

void judge_accuracy(const RigCalibration& calibration, const CalibrationLimits& limits, CalibrationVerdict& verdict) {
  const auto map = error_map(calibration.solution, calibration.observations.screen, 6, 6);
  if (map.empty()) {
    verdict.faults.emplace_back("the camera sees nothing of the screen: let it look down along the screen");
    return;
  }
  double vertical = 0, horizontal = 0;
  for (const ErrorAt& place : map) {
    vertical += place.error.vertical_mm / static_cast<double>(map.size());
    horizontal += place.error.horizontal_mm / static_cast<double>(map.size());
  }
  if (vertical <= limits.predicted_vertical_mm && horizontal <= limits.predicted_horizontal_mm) return;
  verdict.faults.push_back(
      fmt::format("touches would be placed with errors of {:.1f} mm vertically and {:.1f} mm "
                  "horizontally: touch more dots, far to the left and right",
                  vertical, horizontal));
}

}  // namespace

CalibrationVerdict judge_calibration(const RigCalibration& calibration) {
  std::vector<ScreenPoint> dots;
  dots.reserve(calibration.observations.touches.size());
  for (const PointObservation& touch : calibration.observations.touches)
    dots.push_back(touch.screen);
  return judge_calibration(calibration, dots);
}

CalibrationVerdict judge_calibration(const RigCalibration& calibration, const std::vector<ScreenPoint>& dots,
                                     const CalibrationLimits& limits) {
  CalibrationVerdict verdict;
  judge_touches(calibration, dots, limits, verdict);
  judge_camera(calibration, limits, verdict);
  judge_accuracy(calibration, limits, verdict);
  if (calibration.solution.border_rms_px > limits.border_rms_px) {
    verdict.faults.push_back(
        fmt::format("the screen's bottom edge is {:.1f} px from where the touches say: keep hands "
                    "away while it is looked for",
                    calibration.solution.border_rms_px));
  }
  return verdict;
}

}  // namespace telehug
