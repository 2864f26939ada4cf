// SPDX-License-Identifier: Apache-2.0
#include "eval/rigs_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <set>

#include "eval/error_statistics.hpp"
#include "eval/error_table.hpp"
#include "eval/rig_groups.hpp"

namespace telehug {
namespace {

constexpr double outstanding_ratio = 1.5;
constexpr std::size_t enough_touches = 100;

double ratio_of(const std::vector<double>& group, const std::vector<double>& all) {
  return group.empty() || !(mean(all) > 0) ? 0 : mean(group) / mean(all);
}

std::string ratio_text(double ratio) {
  return ratio > 0 ? fmt::format("{:.2f}", ratio) : "-";
}

std::string ratios_text(const ErrorRatio& ratio) {
  return fmt::format("{:>8}{:>6}{:>8}{:>6}{}", ratio_text(ratio.near_vertical), ratio_text(ratio.near_horizontal),
                     ratio_text(ratio.vertical), ratio_text(ratio.horizontal), ratio.stands_out ? " !" : "");
}

}  // namespace

RigsSummary summarise(const std::vector<RigOutcome>& outcomes, std::size_t algorithm) {
  RigsSummary sum;
  sum.rigs = outcomes.size();
  for (const RigOutcome& rig : outcomes) {
    const AlgorithmOutcome& outcome = rig.algorithms.at(algorithm);
    if (!outcome.failure.empty()) {
      ++sum.not_calibrated;
      continue;
    }
    for (const ScoredTouch& touch : outcome.score.touches)
      sum.all.add(touch);
    for (const ScoredRest& rest : outcome.score.rests) {
      sum.all.add(rest);
      sum.rests[rest_group(rest, rig.coat)].add(rest);
    }
    add(sum.groups, outcome.score, rig.groups);
    sum.extras += outcome.score.extras.size();
    std::set<std::string> frames;
    for (const ExtraTouch& extra : outcome.score.extras)
      frames.insert(extra.frame);
    sum.frames_with_extras += frames.size();
  }
  return sum;
}

ErrorRatio error_ratio(const ErrorGroup& group, const ErrorGroup& all) {
  ErrorRatio ratio{ratio_of(group.vertical_mm, all.vertical_mm), ratio_of(group.horizontal_mm, all.horizontal_mm),
                   ratio_of(group.all_vertical_mm, all.all_vertical_mm),
                   ratio_of(group.all_horizontal_mm, all.all_horizontal_mm)};
  const double worst = std::max({ratio.near_vertical, ratio.near_horizontal, ratio.vertical, ratio.horizontal});
  ratio.stands_out = worst > outstanding_ratio && group.touches >= enough_touches;
  return ratio;
}

std::string format_rigs_table(const EvalRigsOptions& options, const std::vector<RigOutcome>& outcomes,
                              std::size_t algorithm) {
  const RigsSummary sum = summarise(outcomes, algorithm);
  const EvalAlgorithm& chosen = options.rig.algorithms.at(algorithm);
  std::string text;
  const auto out = std::back_inserter(text);
  fmt::format_to(
      out,
      "virtual rigs {} to {}: detector {}, model {}; {} dots, {} frames and {} with two fingers or hands each; "
      "{} of {} rigs not calibrated\n",
      options.first_seed, options.first_seed + options.count - 1, chosen.detector, chosen.model, options.rig.dots,
      options.rig.frames, options.rig.hard, sum.not_calibrated, sum.rigs);
  fmt::format_to(out, "{}", error_legend());
  fmt::format_to(out,
                 "ratio: a group's means divided by those of all, near vertical and horizontal, found vertical and "
                 "horizontal; !: one is above {} ({} touches at least)\n",
                 outstanding_ratio, enough_touches);
  fmt::format_to(out, "{}{:>14}{:>14}\n", error_heads(), "near ratio", "found ratio");
  fmt::format_to(out, "{}\n", error_row("all", sum.all));
  for (const auto& [name, group] : groups_that_differ(sum.groups))
    fmt::format_to(out, "{}{}\n", error_row(name, group), ratios_text(error_ratio(group, sum.all)));
  fmt::format_to(out, "frames without a touch in which one was found:\n");
  for (const auto& [name, rests] : sum.rests)
    fmt::format_to(out, "  {:<24}{:>6} of {:>6}\n", name, rests.rests_touched, rests.rests);
  fmt::format_to(out, "touches found beside real ones: {} in {} frames\n", sum.extras, sum.frames_with_extras);
  for (const RigOutcome& rig : outcomes) {
    const std::string& failure = rig.algorithms.at(algorithm).failure;
    if (!failure.empty()) fmt::format_to(out, "virtual:{} was not calibrated: {}\n", rig.seed, failure);
  }
  return text;
}

}  // namespace telehug
