// SPDX-License-Identifier: Apache-2.0
#include "eval_report/html_report.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cmath>
#include <fstream>
#include <map>
#include <optional>
#include <system_error>
#include <vector>

#include "eval_report/box_plot_svg.hpp"
#include "eval_report/error_map_svg.hpp"
#include "eval_report/failure_svg.hpp"
#include "eval_report/html_tables.hpp"
#include "eval_report/markup.hpp"
#include "eval_report/report_style.hpp"
#include "eval_report/screen_svg.hpp"

namespace telehug {
namespace {

constexpr double box_plot_reach_mm = 12;
constexpr double map_high_mm = 5;
constexpr std::size_t most_rows = 300;

std::string section(const std::string& title, const std::string& text, const std::string& content) {
  if (content.empty()) return {};
  const std::string paragraph = text.empty() ? "" : fmt::format("<p class=\"soft\">{}</p>\n", escaped(text));
  return fmt::format("<h2>{}</h2>\n{}{}", escaped(title), paragraph, content);
}

std::string head(const Report& report) {
  std::string html =
      fmt::format("<h1>{}</h1>\n<p class=\"soft\">{}</p>\n<dl>\n", escaped(report.title), escaped(report.date));
  for (const auto& [name, value] : report.facts)
    html += fmt::format("<dt>{}</dt><dd>{}</dd>\n", escaped(name), escaped(value));
  html += "</dl>\n";
  if (!report.failures.empty()) {
    html +=
        "<p class=\"warning\">This page contains camera pictures: of a desk, and of hands if a camera took them. "
        "Whoever gets the page gets the pictures.</p>\n";
  }
  return html;
}

std::string box_plots(const Report& report) {
  if (report.touches.empty()) return {};
  const ErrorGroups told = groups_that_differ(report.algorithms.front().groups);
  const auto rows_of = [&](double ScoredTouch::*error_mm) {
    std::map<std::string, std::vector<double>> groups;
    BoxPlotRow all{"all", {}};
    for (const ReportedTouch& reported : report.touches) {
      if (!reported.touch.found) continue;
      all.values.push_back(reported.touch.*error_mm);
      for (const std::string& group : reported.groups) {
        if (told.contains(group)) groups[group].push_back(reported.touch.*error_mm);
      }
    }
    std::vector<BoxPlotRow> rows{std::move(all)};
    for (auto& [name, values] : groups)
      rows.push_back({name, std::move(values)});
    return rows;
  };
  return "<div class=\"row\">" +
         box_plots_svg("Vertical error, mm (positive: found below)", rows_of(&ScoredTouch::vertical_error_mm),
                       box_plot_reach_mm) +
         box_plots_svg("Horizontal error, mm (positive: found to the right)",
                       rows_of(&ScoredTouch::horizontal_error_mm), box_plot_reach_mm) +
         "</div>\n";
}

std::string maps(const Report& report) {
  if (report.touches.empty()) return {};
  const auto of_near = [&](double ScoredTouch::*error_mm) {
    return map_errors(report.touches, [error_mm](const ScoredTouch& touch) {
      return touch.near() ? std::optional(std::abs(touch.*error_mm)) : std::nullopt;
    });
  };
  const ErrorMap failed =
      map_errors(report.touches, [](const ScoredTouch& touch) { return std::optional(touch.near() ? 0.0 : 100.0); });
  return "<div class=\"row\">" +
         error_map_svg("Vertical error of near touches, mm", of_near(&ScoredTouch::vertical_error_mm), map_high_mm, 1) +
         error_map_svg("Horizontal error of near touches, mm", of_near(&ScoredTouch::horizontal_error_mm), map_high_mm,
                       1) +
         error_map_svg("Missed or far off, %", failed, 100, 0) + "</div>\n";
}

std::string pictures(const Report& report) {
  if (report.failures.empty()) return {};
  std::string html =
      "<p>Rings mark places on the screen: <b class=\"key-true\">true</b>, <b class=\"key-found\">found</b>.</p>\n"
      "<div class=\"pictures\">\n";
  for (const FailurePicture& picture : report.failures)
    html += failure_figure(picture);
  return html + "</div>\n";
}

std::string faults(const Report& report) {
  if (report.faults.empty()) return {};
  std::string html = "<ul>\n";
  for (const std::string& fault : report.faults)
    html += fmt::format("<li>{}</li>\n", escaped(fault));
  return html + "</ul>\n";
}

std::string touches(const Report& report) {
  return report.touches.empty() ? "" : touches_table(report.touches, most_rows);
}

std::string rests(const Report& report) {
  return report.algorithms.front().rests.empty() ? "" : rests_table(report.algorithms);
}

std::string groups(const Report& report) {
  return report.algorithms.front().groups.empty() ? "" : groups_table(report.algorithms.front());
}

std::string comparison(const Report& report) {
  return report.algorithms.size() < 2 ? "" : comparison_table(report.algorithms);
}

std::string residuals(const Report& report) {
  return report.calibration.empty() ? "" : calibration_table(report.calibration);
}

}  // namespace

std::string html_report(const Report& report) {
  const bool shortened = report.touches.size() > most_rows;
  return fmt::format(
             "<!DOCTYPE html>\n<html lang=\"en\">\n<head><meta charset=\"utf-8\"><meta name=\"viewport\" "
             "content=\"width=device-width\"><title>{}</title>\n<style>{}</style></head>\n<body>\n",
             escaped(report.title), report_style) +
         head(report) +
         section("Errors",
                 fmt::format("In mm: mean size (95 % are smaller). Near: at most {:.0f} mm off; far: more; "
                             "found: both.",
                             near_enough_mm),
                 summary_table(report.algorithms)) +
         section("Not evaluated", "", faults(report)) +
         section("By groups",
                 "The last columns give a group's means as multiples of everybody's; red: one is above 1.5, of 100 "
                 "touches or more.",
                 groups(report)) +
         section("Algorithms beside each other", "On the same pictures, of the rigs that each could calibrate.",
                 comparison(report)) +
         section("False touches", "Frames in which nothing touches, and in how many a touch was found.",
                 rests(report)) +
         section("Where", "", screen_svg(report.touches, report.one_screen)) +
         section(
             "Distribution",
             "Of all found touches: median, quartiles, whiskers to 1.5 times the box, outliers; how many lie beyond "
             "the axis.",
             box_plots(report)) +
         section("Over the screen", "The mean in each field, below it of how many touches. The camera is at the top.",
                 maps(report)) +
         section("Failures", "Missed, far off and false touches, the biggest of each first.", pictures(report)) +
         section("Calibration", "Where the solved camera places the touches that calibrated it, minus where they were.",
                 residuals(report)) +
         section("Touches",
                 shortened ? fmt::format("In mm. The worst {} of {}; means are of all found ones.", most_rows,
                                         report.touches.size())
                           : std::string("In mm. Means are of all found ones."),
                 touches(report)) +
         "</body>\n</html>\n";
}

Status write_html_report(const std::filesystem::path& path, const Report& report) {
  std::ofstream out(path, std::ios::binary);
  out << html_report(report);
  out.close();
  if (out) return Done{};
  return Error{fmt::format("can't write {}: {}", path.string(), std::generic_category().message(errno))};
}

}  // namespace telehug
