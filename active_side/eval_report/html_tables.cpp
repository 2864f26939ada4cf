// SPDX-License-Identifier: Apache-2.0
#include "eval_report/html_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "eval/error_statistics.hpp"
#include "eval/rigs_table.hpp"
#include "eval_report/markup.hpp"

namespace telehug {
namespace {

using Cells = std::vector<std::string>;

// The first cell names the row; all are text.
std::string row_of(const Cells& cells, const char* kind = "") {
  std::string html = fmt::format("<tr{}>", *kind == '\0' ? std::string() : fmt::format(" class=\"{}\"", kind));
  for (std::size_t i = 0; i < cells.size(); ++i)
    html += i == 0 ? "<th scope=\"row\">" + escaped(cells[i]) + "</th>" : "<td>" + escaped(cells[i]) + "</td>";
  return html + "</tr>\n";
}

std::string heads_of(const Cells& heads) {
  std::string html = "<thead><tr>";
  for (const std::string& head : heads)
    html += "<th scope=\"col\">" + escaped(head) + "</th>";
  return html + "</tr></thead>\n";
}

std::string table_of(const Cells& heads, const std::string& rows) {
  return "<div class=\"scroll\"><table>" + heads_of(heads) + "<tbody>" + rows + "</tbody></table></div>\n";
}

std::string mean_and_p95(const std::vector<double>& values) {
  return values.empty() ? "–" : fmt::format("{:.1f} ({:.1f})", mean(values), p95(values));
}

std::string ratio_text(double near, double found) {
  const auto text = [](double ratio) { return ratio > 0 ? fmt::format("{:.2f}", ratio) : std::string("–"); };
  return text(near) + " / " + text(found);
}

void append(Cells& cells, const ErrorGroup& group) {
  for (const std::size_t count : {group.missed(), group.far()})
    cells.push_back(fmt::format("{}", count));
  for (const auto* values :
       {&group.vertical_mm, &group.horizontal_mm, &group.all_vertical_mm, &group.all_horizontal_mm})
    cells.push_back(mean_and_p95(*values));
}

const Cells number_heads{"missed", "far", "near: vertical", "horizontal", "found: vertical", "horizontal"};

ErrorGroup group_in(const ErrorGroups& groups, const std::string& name) {
  const auto found = groups.find(name);
  return found == groups.end() ? ErrorGroup{} : found->second;
}

// Values of touches, and below them their means and standard deviations.
struct Column {
  std::vector<double> values;
  [[nodiscard]] std::string mean_text() const { return values.empty() ? "–" : fmt::format("{:.2f}", mean(values)); }
  [[nodiscard]] std::string sd_text() const {
    return values.empty() ? "–" : fmt::format("{:.2f}", standard_deviation(values));
  }
};

double how_bad(const ReportedTouch& reported) {
  return reported.touch.found ? reported.touch.error_mm() : std::numeric_limits<double>::infinity();
}

std::string touch_row(const ReportedTouch& reported) {
  const ScoredTouch& touch = reported.touch;
  Cells cells{reported.frame, fmt::format("{:.1f}", touch.place.x_mm), fmt::format("{:.1f}", touch.place.y_mm)};
  if (touch.found) {
    for (const double value : {touch.found_place().x_mm, touch.found_place().y_mm})
      cells.push_back(fmt::format("{:.1f}", value));
    for (const double value : {touch.horizontal_error_mm, touch.vertical_error_mm})
      cells.push_back(fmt::format("{:+.1f}", value));
    cells.push_back(fmt::format("{:.1f}", touch.error_mm()));
  } else {
    cells.insert(cells.end(), {"missed", "", "", "", ""});
  }
  cells.insert(cells.end(), {touch.tone, touch.screen, touch.notes});
  return row_of(cells, touch.near() ? "" : "bad");
}

}  // namespace

std::string summary_table(const std::vector<ReportedAlgorithm>& algorithms) {
  std::string rows;
  for (const ReportedAlgorithm& algorithm : algorithms) {
    Cells cells{algorithm.name};
    if (!algorithm.failure.empty()) {
      cells.push_back(algorithm.failure);
    } else {
      cells.push_back(fmt::format("{}", algorithm.all.touches));
      append(cells, algorithm.all);
      cells.push_back(fmt::format("{} of {}", algorithm.all.rests_touched, algorithm.all.rests));
      cells.push_back(fmt::format("{}", algorithm.extras));
    }
    rows += row_of(cells);
  }
  Cells heads{"", "touches"};
  heads.insert(heads.end(), number_heads.begin(), number_heads.end());
  heads.insert(heads.end(), {"false in frames without a touch", "beside touches"});
  return table_of(heads, rows);
}

std::string groups_table(const ReportedAlgorithm& algorithm) {
  Cells heads{"", "touches"};
  heads.insert(heads.end(), number_heads.begin(), number_heads.end());
  heads.insert(heads.end(), {"vertical by all: near / found", "horizontal by all: near / found"});
  std::string rows;
  for (const auto& [name, group] : groups_that_differ(algorithm.groups)) {
    const ErrorRatio ratio = error_ratio(group, algorithm.all);
    Cells cells{name, fmt::format("{}", group.touches)};
    append(cells, group);
    cells.push_back(ratio_text(ratio.near_vertical, ratio.vertical));
    cells.push_back(ratio_text(ratio.near_horizontal, ratio.horizontal));
    rows += row_of(cells, ratio.stands_out ? "bad" : "");
  }
  return table_of(heads, rows);
}

std::string comparison_table(const std::vector<ReportedAlgorithm>& algorithms) {
  Cells heads{""};
  for (const ReportedAlgorithm& algorithm : algorithms) {
    heads.push_back(algorithm.name + ": touches");
    heads.insert(heads.end(), {"missed", "far", "found: vertical", "horizontal"});
  }
  std::string rows;
  for (const auto& [name, ignored] : groups_that_differ(algorithms.front().groups)) {
    Cells cells{name};
    for (const ReportedAlgorithm& algorithm : algorithms) {
      const ErrorGroup group = group_in(algorithm.groups, name);
      for (const std::size_t count : {group.touches, group.missed(), group.far()})
        cells.push_back(fmt::format("{}", count));
      for (const auto* values : {&group.all_vertical_mm, &group.all_horizontal_mm})
        cells.push_back(mean_and_p95(*values));
    }
    rows += row_of(cells);
  }
  return table_of(heads, rows);
}

std::string rests_table(const std::vector<ReportedAlgorithm>& algorithms) {
  Cells heads{"nothing touches"};
  std::set<std::string> names;
  for (const ReportedAlgorithm& algorithm : algorithms) {
    heads.push_back(algorithm.name);
    for (const auto& [name, group] : algorithm.rests)
      names.insert(name);
  }
  std::string rows;
  for (const std::string& name : names) {
    Cells cells{name};
    for (const ReportedAlgorithm& algorithm : algorithms) {
      const ErrorGroup group = group_in(algorithm.rests, name);
      cells.push_back(fmt::format("{} of {}", group.rests_touched, group.rests));
    }
    rows += row_of(cells);
  }
  return table_of(heads, rows);
}

std::string calibration_table(const std::vector<CalibrationError>& errors) {
  std::string rows;
  for (const CalibrationError& touch : errors) {
    rows += row_of({touch.name, fmt::format("{:.1f}", touch.place.x_mm), fmt::format("{:.1f}", touch.place.y_mm),
                    fmt::format("{:+.2f}", touch.error_mm.x_mm), fmt::format("{:+.2f}", touch.error_mm.y_mm)});
  }
  return table_of({"touch", "x", "y", "horizontal residual", "vertical residual"}, rows);
}

std::string touches_table(const std::vector<ReportedTouch>& touches, std::size_t most) {
  std::vector<const ReportedTouch*> shown;
  Column horizontal, vertical, horizontal_size, vertical_size, distance;
  for (const ReportedTouch& reported : touches) {
    shown.push_back(&reported);
    if (!reported.touch.found) continue;
    horizontal.values.push_back(reported.touch.horizontal_error_mm);
    vertical.values.push_back(reported.touch.vertical_error_mm);
    horizontal_size.values.push_back(std::abs(reported.touch.horizontal_error_mm));
    vertical_size.values.push_back(std::abs(reported.touch.vertical_error_mm));
    distance.values.push_back(reported.touch.error_mm());
  }
  if (shown.size() > most) {
    std::sort(shown.begin(), shown.end(), [](const auto* a, const auto* b) {
      const double bad = how_bad(*a);
      const double other = how_bad(*b);
      return bad != other ? bad > other : a < b;  // as they stand in `touches`
    });
    shown.resize(most);
  }
  std::string rows;
  for (const ReportedTouch* reported : shown)
    rows += touch_row(*reported);
  rows += row_of({"mean", "", "", "", "", horizontal.mean_text(), vertical.mean_text(), distance.mean_text()}, "sum");
  rows += row_of({"standard deviation", "", "", "", "", horizontal.sd_text(), vertical.sd_text(), distance.sd_text()},
                 "sum");
  rows += row_of({"mean of sizes", "", "", "", "", horizontal_size.mean_text(), vertical_size.mean_text()}, "sum");
  rows +=
      row_of({"their standard deviation", "", "", "", "", horizontal_size.sd_text(), vertical_size.sd_text()}, "sum");
  return table_of({"frame", "true x", "true y", "found x", "found y", "horizontal error", "vertical error", "distance",
                   "tone", "screen", "notes"},
                  rows);
}

}  // namespace telehug
