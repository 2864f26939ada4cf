// SPDX-License-Identifier: Apache-2.0
#include "eval/error_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

namespace telehug {
namespace {

using Output = std::back_insert_iterator<std::string>;

struct Group {
  std::size_t touches = 0;
  std::size_t found = 0;
  std::vector<double> vertical_mm;  // of the near ones
  std::vector<double> horizontal_mm;
  std::vector<double> all_vertical_mm;  // of all found ones
  std::vector<double> all_horizontal_mm;
  std::size_t rests = 0;
  std::size_t rests_touched = 0;

  [[nodiscard]] std::size_t near() const { return vertical_mm.size(); }
};

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

// The smallest value that at least 95 % do not exceed.
double p95(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const auto rank = static_cast<std::size_t>(std::ceil(0.95 * static_cast<double>(values.size())));
  return values[rank - 1];
}

std::string mean_and_p95(const std::vector<double>& values) {
  return values.empty() ? "-" : fmt::format("{:.1f} ({:.1f})", mean(values), p95(values));
}

void add(Group& group, const ScoredTouch& touch) {
  ++group.touches;
  if (!touch.found) return;
  ++group.found;
  const double vertical_mm = std::abs(touch.vertical_error_mm);
  const double horizontal_mm = std::abs(touch.horizontal_error_mm);
  group.all_vertical_mm.push_back(vertical_mm);
  group.all_horizontal_mm.push_back(horizontal_mm);
  if (std::hypot(vertical_mm, horizontal_mm) > near_enough_mm) return;
  group.vertical_mm.push_back(vertical_mm);
  group.horizontal_mm.push_back(horizontal_mm);
}

void add(Group& group, const ScoredRest& rest) {
  ++group.rests;
  if (rest.false_touches > 0) ++group.rests_touched;
}

void print_row(Output out, const std::string& name, const Group& group) {
  fmt::format_to(out, "{:<16}{:>8}{:>8}{:>8}{:>8}{:>14}{:>14}{:>14}{:>14}{:>10}\n", name, group.touches,
                 group.touches - group.found, group.found - group.near(), group.near(), mean_and_p95(group.vertical_mm),
                 mean_and_p95(group.horizontal_mm), mean_and_p95(group.all_vertical_mm),
                 mean_and_p95(group.all_horizontal_mm), fmt::format("{}/{}", group.rests_touched, group.rests));
}

void print_groups(Output out, const TouchScore& score, const std::string& title,
                  const std::function<std::string(const ScoredTouch&)>& of_touch,
                  const std::function<std::string(const ScoredRest&)>& of_rest) {
  std::map<std::string, Group> groups;
  for (const ScoredTouch& touch : score.touches)
    add(groups[of_touch(touch)], touch);
  for (const ScoredRest& rest : score.rests) {
    if (const std::string key = of_rest(rest); !key.empty()) add(groups[key], rest);
  }
  for (const auto& [name, group] : groups)
    print_row(out, fmt::format("{} {}", title, name), group);
}

void print_false_touches(Output out, const TouchScore& score) {
  std::map<std::string, std::pair<std::size_t, std::size_t>> kinds;
  for (const ScoredRest& rest : score.rests) {
    auto& [touched, frames] = kinds[rest.kind];
    ++frames;
    if (rest.false_touches > 0) ++touched;
  }
  fmt::format_to(out, "false touches:");
  for (const auto& [kind, counts] : kinds)
    fmt::format_to(out, " {} {} of {} frames,", kind, counts.first, counts.second);
  fmt::format_to(out, " beside real touches {}\n", score.extra_touches);
}

std::string name_of_choice(const std::string& asked, const std::string& used) {
  return asked == used ? used : fmt::format("{} ({} at present)", asked, used);
}

}  // namespace

std::string format_error_table(const EvalTouchReport& report) {
  std::string text;
  const Output out(text);
  const Calibration& calibration = report.calibration;
  fmt::format_to(out, "{}, part {}: detector {}, model {}\n", report.options.rig.string(), report.options.part,
                 name_of_choice(report.options.detector, report.detector),
                 name_of_choice(report.options.model, report.model));
  fmt::format_to(out, "border v = {:.1f} px {:+.4f} u; camera {:.0f} mm below the screen's top\n",
                 calibration.border.v0_px, calibration.border.slope, calibration.camera_below_top_mm());
  for (const std::string& fault : report.unreadable)
    fmt::format_to(out, "not used: {}\n", fault);
  if (!report.score) {
    fmt::format_to(out, "{} frames; there is no truth.csv to compare with\n", report.found.size());
    return text;
  }
  const TouchScore& score = *report.score;
  Group all;
  for (const ScoredTouch& touch : score.touches)
    add(all, touch);
  for (const ScoredRest& rest : score.rests)
    add(all, rest);
  fmt::format_to(out,
                 "missed: nothing found; far, near: found more or at most {:.0f} mm off; errors in mm: mean (p95); "
                 "false: frames without a touch in which one was found\n",
                 near_enough_mm);
  fmt::format_to(out, "{:<16}{:>8}{:>8}{:>8}{:>8}{:>14}{:>14}{:>14}{:>14}{:>10}\n", "", "touches", "missed", "far",
                 "near", "near vert.", "near horiz.", "found vert.", "found horiz.", "false");
  print_row(out, "all", all);
  print_groups(
      out, score, "tone", [](const ScoredTouch& touch) { return touch.tone; },
      [](const ScoredRest& rest) { return rest.tone; });
  print_groups(
      out, score, "screen", [](const ScoredTouch& touch) { return touch.screen; },
      [](const ScoredRest& rest) { return rest.screen; });
  print_false_touches(out, score);
  if (report.dropped > 0) {
    fmt::format_to(out, "{} fingers lay too far outside the screen and were dropped\n", report.dropped);
  }
  return text;
}

}  // namespace telehug
