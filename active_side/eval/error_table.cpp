// SPDX-License-Identifier: Apache-2.0
#include "eval/error_table.hpp"

#include <fmt/format.h>

#include <iterator>
#include <map>
#include <utility>
#include <vector>

#include "eval/error_statistics.hpp"

namespace telehug {
namespace {

using Output = std::back_insert_iterator<std::string>;

std::string mean_and_p95(const std::vector<double>& values) {
  return values.empty() ? "-" : fmt::format("{:.1f} ({:.1f})", mean(values), p95(values));
}

void print_false_touches(Output out, const TouchScore& score) {
  std::map<std::string, std::pair<std::size_t, std::size_t>> kinds;
  for (const ScoredRest& rest : score.rests) {
    auto& [touched, frames] = kinds[rest.kind];
    ++frames;
    if (!rest.false_touches.empty()) ++touched;
  }
  fmt::format_to(out, "false touches:");
  for (const auto& [kind, counts] : kinds)
    fmt::format_to(out, " {} {} of {} frames,", kind, counts.first, counts.second);
  fmt::format_to(out, " beside real touches {}\n", score.extras.size());
}

}  // namespace

std::string error_legend() {
  return fmt::format(
      "missed: nothing found; far, near: found more or at most {:.0f} mm off; errors in mm: mean (p95); "
      "false: frames without a touch in which one was found\n",
      near_enough_mm);
}

std::string error_heads() {
  return fmt::format("{:<18}{:>8}{:>8}{:>8}{:>8}{:>14}{:>14}{:>14}{:>14}{:>10}", "", "touches", "missed", "far", "near",
                     "near vert.", "near horiz.", "found vert.", "found horiz.", "false");
}

std::string error_row(const std::string& name, const ErrorGroup& group) {
  return fmt::format("{:<18}{:>8}{:>8}{:>8}{:>8}{:>14}{:>14}{:>14}{:>14}{:>10}", name, group.touches, group.missed(),
                     group.far(), group.near(), mean_and_p95(group.vertical_mm), mean_and_p95(group.horizontal_mm),
                     mean_and_p95(group.all_vertical_mm), mean_and_p95(group.all_horizontal_mm),
                     fmt::format("{}/{}", group.rests_touched, group.rests));
}

std::string format_error_table(const EvalTouchReport& report) {
  std::string text;
  const Output out(text);
  const Calibration& calibration = report.calibration;
  fmt::format_to(out, "{}, part {}: detector {}, model {}\n", report.options.rig.string(), report.options.part,
                 report.options.algorithm.detector, report.options.algorithm.model);
  fmt::format_to(out, "border v = {:.1f} px {:+.4f} u; camera {:.0f} mm below the screen's top\n",
                 calibration.border.v0_px, calibration.border.slope, calibration.camera_below_top_mm());
  for (const std::string& fault : report.part.unreadable)
    fmt::format_to(out, "not used: {}\n", fault);
  for (const EvaluatedContact& contact : report.part.contacts) {
    fmt::format_to(out, "contact {}: from frame {} {}\n", contact.id, contact.down,
                   contact.up.empty() ? "on" : "until frame " + contact.up);
  }
  if (!report.score) {
    fmt::format_to(out, "{} frames; there is no truth.csv to compare with\n", report.part.found.size());
    return text;
  }
  fmt::format_to(out, "{}{}\n", error_legend(), error_heads());
  fmt::format_to(out, "{}\n", error_row("all", whole(*report.score)));
  ErrorGroups groups;
  add(groups, *report.score);
  for (const auto& [name, group] : groups_that_differ(groups))
    fmt::format_to(out, "{}\n", error_row(name, group));
  print_false_touches(out, *report.score);
  if (report.part.dropped > 0) {
    fmt::format_to(out, "{} fingers lay too far outside the screen and were dropped\n", report.part.dropped);
  }
  return text;
}

}  // namespace telehug
