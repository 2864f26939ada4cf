// SPDX-License-Identifier: Apache-2.0
#include "setup/setup_result.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <variant>

#include "calibration/calibration_policy.hpp"

namespace telehug {
namespace {

constexpr int map_columns = 12;
constexpr int map_rows = 8;
// Fingers differ from the one that has calibrated: see TipNoise.
constexpr TipNoise usual_noise{0.3, 0.3, 4.5};
constexpr double agrees_mm = 1;

SetupResult without_touches(const std::vector<ScreenPoint>& dots, const std::vector<bool>& taken) {
  SetupResult result;
  for (std::size_t i = 0; i < dots.size(); ++i)
    result.dots.push_back({dots[i], !taken[i], false, std::nullopt});
  return result;
}

std::size_t dot_of(const std::vector<ScreenPoint>& dots, const PointObservation& touch) {
  return static_cast<std::size_t>(std::find(dots.begin(), dots.end(), touch.screen) - dots.begin());
}

void add_errors(const RigSolution& solution, const ScreenSize& screen, SetupErrorMap& map) {
  map = {map_columns, map_rows, std::vector<std::optional<PredictedError>>(map_columns * map_rows)};
  for (const ErrorAt& place : error_map(solution, screen, map_columns, map_rows, usual_noise)) {
    const auto column = static_cast<std::size_t>(place.screen.x_mm / screen.width_mm * map_columns);
    const auto row = static_cast<std::size_t>(place.screen.y_mm / screen.height_mm * map_rows);
    map.fields[row * map_columns + column] = place.error;
  }
}

}  // namespace

SetupResult failed_setup(const std::string& why, const std::vector<ScreenPoint>& dots, const std::vector<bool>& taken) {
  SetupResult result = without_touches(dots, taken);
  result.faults.push_back(why);
  for (std::size_t i = 0; i < dots.size(); ++i) {
    if (taken[i]) result.repeat.push_back(i);
  }
  return result;
}

SetupResult judge_setup(const Calibration& calibration, const std::vector<ScreenPoint>& dots,
                        const std::vector<bool>& taken) {
  SetupResult result = without_touches(dots, taken);
  const auto* const rig = std::get_if<RigCalibration>(&calibration.solved);
  if (rig == nullptr) {
    for (DotOutcome& dot : result.dots)
      dot.used = !dot.skipped;
    return result;
  }
  const std::vector<PointObservation>& touches = rig->observations.touches;
  for (std::size_t i = 0; i < touches.size(); ++i) {
    DotOutcome& dot = result.dots.at(dot_of(dots, touches[i]));
    dot.used = !touches[i].left_out && rig->solution.bad_touch != i;
    dot.error_mm = rig->solution.touches[i].error_mm;
  }
  CalibrationVerdict verdict = judge_calibration(*rig);
  // One that was not used first, then the one that a bad calibration suffers from most. One that lies where the others
  // say would tell nothing new.
  for (std::size_t i = 0; i < dots.size(); ++i) {
    const DotOutcome& dot = result.dots[i];
    const bool agrees =
        verdict.good() && dot.error_mm && std::hypot(dot.error_mm->x_mm, dot.error_mm->y_mm) < agrees_mm;
    if (!dot.used && !dot.skipped && !agrees) result.repeat.push_back(i);
  }
  if (verdict.repeat && !verdict.good()) {
    const std::size_t worst = dot_of(dots, touches[*verdict.repeat]);
    if (std::find(result.repeat.begin(), result.repeat.end(), worst) == result.repeat.end())
      result.repeat.push_back(worst);
  }
  result.faults = std::move(verdict.faults);
  result.remarks = std::move(verdict.advice);
  result.reach = reach(rig->solution.model, calibration.screen);
  add_errors(rig->solution, calibration.screen, result.errors);
  return result;
}

}  // namespace telehug
