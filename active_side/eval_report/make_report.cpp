// SPDX-License-Identifier: Apache-2.0
#include "eval_report/make_report.hpp"

#include <fmt/format.h>

#include <cmath>
#include <variant>

#include "eval/error_statistics.hpp"
#include "eval/rigs_table.hpp"

namespace telehug {
namespace {

constexpr std::size_t failures_shown = 24;

std::string name_of(const EvalAlgorithm& algorithm) {
  return fmt::format("detector {}, model {}", algorithm.detector, algorithm.model);
}

ReportedAlgorithm algorithm_of(const EvalTouchReport& evaluated) {
  ReportedAlgorithm algorithm;
  algorithm.name = name_of(evaluated.options.algorithm);
  if (!evaluated.score) {
    algorithm.failure = "there is no truth.csv to compare with";
    return algorithm;
  }
  algorithm.all = whole(*evaluated.score);
  add(algorithm.groups, *evaluated.score);
  for (const ScoredRest& rest : evaluated.score->rests)
    algorithm.rests[rest.kind].add(rest);
  algorithm.extras = evaluated.score->extras.size();
  return algorithm;
}

ReportedAlgorithm algorithm_of(const EvalRigsOptions& options, const RigsResult& result, std::size_t which) {
  RigsSummary sum = summarise(result.rigs, which);
  ReportedAlgorithm algorithm;
  algorithm.name = name_of(options.rig.algorithms.at(which));
  if (sum.not_calibrated > 0) {
    algorithm.name += fmt::format(" ({} of {} rigs not calibrated)", sum.not_calibrated, sum.rigs);
  }
  algorithm.all = std::move(sum.all);
  algorithm.groups = std::move(sum.groups);
  algorithm.rests = std::move(sum.rests);
  algorithm.extras = sum.extras;
  return algorithm;
}

// What the calibration says of itself.
void add_calibration(const Calibration& calibration, Report& report) {
  report.facts.emplace_back(
      "screen", fmt::format("{:.0f} x {:.0f} mm", calibration.screen.width_mm, calibration.screen.height_mm));
  report.facts.emplace_back(
      "picture", fmt::format("{} x {} px; border v = {:.1f} px {:+.4f} u", calibration.image.width_px,
                             calibration.image.height_px, calibration.border.v0_px, calibration.border.slope));
  report.facts.emplace_back("camera",
                            fmt::format("{:.0f} mm below the screen's top", calibration.camera_below_top_mm()));
  const auto* rig = std::get_if<RigCalibration>(&calibration.solved);
  if (rig == nullptr) return;
  const RigSolution& solution = rig->solution;
  report.facts.emplace_back("calibration fit", fmt::format("reduced chi squared {:.2f}; border {:.2f} px rms",
                                                           solution.reduced_chi2, solution.border_rms_px));
  for (std::size_t i = 0; i < solution.touches.size(); ++i) {
    const PointObservation& seen = rig->observations.touches[i];
    report.calibration.push_back({fmt::format("{} {}{}", i + 1, name_of(seen.evidence),
                                              solution.bad_touch == i || seen.left_out ? ", left out" : ""),
                                  seen.screen, solution.touches[i].error_mm});
  }
}

std::string residual_fact(const RigsResult& result) {
  std::vector<double> vertical_mm;
  std::vector<double> horizontal_mm;
  for (const RigOutcome& rig : result.rigs) {
    for (const ScreenPoint& error : rig.algorithms.front().calibration_errors_mm) {
      vertical_mm.push_back(std::abs(error.y_mm));
      horizontal_mm.push_back(std::abs(error.x_mm));
    }
  }
  if (vertical_mm.empty()) return "none: each touch fits exactly";
  return fmt::format("mean {:.2f} mm vertical, {:.2f} mm horizontal; 95 % below {:.2f} and {:.2f} mm",
                     mean(vertical_mm), mean(horizontal_mm), p95(vertical_mm), p95(horizontal_mm));
}

}  // namespace

Report report_of(const EvalTouchReport& evaluated, const std::optional<Result<EvalTouchReport>>& thesis,
                 const std::string& date) {
  Report report;
  const std::filesystem::path rig = evaluated.options.rig;
  report.title = fmt::format("Touches of {}", (rig.has_filename() ? rig : rig.parent_path()).filename().string());
  report.date = date;
  report.facts.emplace_back("recording", fmt::format("{}, part {}, {} frames", rig.string(), evaluated.options.part,
                                                     evaluated.part.found.size()));
  report.facts.emplace_back("algorithm", name_of(evaluated.options.algorithm));
  add_calibration(evaluated.calibration, report);
  report.algorithms.push_back(algorithm_of(evaluated));
  if (thesis) {
    report.algorithms.push_back(
        *thesis ? algorithm_of(**thesis)
                : ReportedAlgorithm{name_of(thesis_algorithm), thesis->error().message, {}, {}, {}, 0});
  }
  report.faults = evaluated.part.unreadable;
  report.failures = share_out(evaluated.failures, failures_shown);
  if (!evaluated.score) return report;
  for (const ScoredTouch& touch : evaluated.score->touches)
    report.touches.push_back({touch.frame, evaluated.calibration.screen, groups_of(touch), touch});
  return report;
}

Report report_of(const EvalRigsOptions& options, const RigsResult& result, const std::string& date) {
  Report report;
  report.title =
      fmt::format("Touches of virtual rigs {} to {}", options.first_seed, options.first_seed + result.rigs.size() - 1);
  report.date = date;
  report.one_screen = false;
  report.facts.emplace_back("pictures", fmt::format("{} rigs drawn at random, each with {} frames and {} with two "
                                                    "fingers or two hands",
                                                    result.rigs.size(), options.rig.frames, options.rig.hard));
  report.facts.emplace_back("calibration", fmt::format("{} touched dots, triangle and border", options.rig.dots));
  report.facts.emplace_back("calibration residuals", residual_fact(result));
  report.facts.emplace_back("algorithm", name_of(options.rig.algorithms.front()));
  for (std::size_t i = 0; i < options.rig.algorithms.size(); ++i)
    report.algorithms.push_back(algorithm_of(options, result, i));
  for (const RigOutcome& rig : result.rigs) {
    const AlgorithmOutcome& outcome = rig.algorithms.front();
    if (!outcome.failure.empty()) {
      report.faults.push_back(fmt::format("virtual:{} was not calibrated: {}", rig.seed, outcome.failure));
    }
    for (const ScoredTouch& touch : outcome.score.touches) {
      std::vector<std::string> groups = groups_of(touch);
      groups.insert(groups.end(), rig.groups.begin(), rig.groups.end());
      report.touches.push_back({fmt::format("virtual:{} {}", rig.seed, touch.frame), rig.screen, groups, touch});
    }
  }
  report.failures = share_out(result.failures, failures_shown);
  return report;
}

}  // namespace telehug
