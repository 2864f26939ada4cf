// SPDX-License-Identifier: Apache-2.0
#include "eval_report/html_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "eval_report/html_tables.hpp"

namespace telehug {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

ReportedTouch touch(const std::string& frame, bool found, double horizontal_mm, double vertical_mm) {
  return {frame,
          {400, 300, 1280, 1024},
          {"tone II"},
          {frame, "II", "chat", found, vertical_mm, horizontal_mm, {100, 200}, "touch"}};
}

Report report_with(std::vector<ReportedTouch> touches) {
  Report report;
  report.title = "Rig <script>alert('1')</script>";
  report.date = "2026-01-01T00:00:00Z";
  report.facts = {{"recording", "a & b"}};
  report.algorithms = {{"detector default, model default", "", {}, {}, {}, 0}};
  for (const ReportedTouch& one : touches)
    report.algorithms[0].all.add(one.touch);
  report.touches = std::move(touches);
  return report;
}

TEST(HtmlReport, EscapesAllThatComesFromTheEvaluation) {
  Report report = report_with({touch("\"><b>", true, 1, 2), touch("2", false, 0, 0)});
  report.faults = {"<img src=x>"};
  report.algorithms.push_back({"thesis", "can't <be> calibrated", {}, {}, {}, 0});
  report.calibration = {{"<i>", {1, 2}, {0.1, 0.2}}};
  const std::string html = html_report(report);
  EXPECT_THAT(html, AllOf(Not(HasSubstr("<script")), Not(HasSubstr("<img")), Not(HasSubstr("<be>"))));
  EXPECT_THAT(html, AllOf(Not(HasSubstr("><b>")), Not(HasSubstr("<i>"))));
  EXPECT_THAT(html, HasSubstr("a &amp; b"));
}

TEST(HtmlReport, NeedsNothingFromOutside) {
  const std::string html = html_report(report_with({touch("1", true, 1, 2)}));
  EXPECT_THAT(html, AllOf(Not(HasSubstr("src=")), Not(HasSubstr("<link")), Not(HasSubstr("url("))));
  EXPECT_THAT(html, HasSubstr("prefers-color-scheme: dark"));
}

TEST(HtmlReport, WarnsOfCameraPicturesOnlyIfItHoldsSome) {
  Report report = report_with({touch("1", true, 30, 40)});
  EXPECT_THAT(html_report(report), Not(HasSubstr("camera pictures")));
  report.failures = {{{FailureKind::far, "1", "50.0 mm off; <tone>", 50, ScreenPoint{100, 200}, ScreenPoint{130, 240}},
                      {0xFF, 0xD8, 0xFF},
                      {320, 180},
                      ImagePoint{10, 20},
                      std::nullopt}};
  const std::string html = html_report(report);
  EXPECT_THAT(html, HasSubstr("This page contains camera pictures"));
  EXPECT_THAT(html, HasSubstr("href=\"data:image/jpeg;base64,/9j/\""));
  EXPECT_THAT(html, HasSubstr("mark-true"));
  EXPECT_THAT(html, Not(HasSubstr("class=\"mark-found\"")));
  EXPECT_THAT(html, HasSubstr("50.0 mm off; &lt;tone&gt;"));
}

TEST(HtmlReport, SaysSoWhenThereIsNoTruth) {
  Report report = report_with({});
  report.algorithms[0].failure = "there is no truth.csv to compare with";
  EXPECT_THAT(html_report(report), HasSubstr("there is no truth.csv"));
}

TEST(TouchesTable, HasTheThesisColumnsMeansAndSpreads) {
  const std::string table =
      touches_table({touch("1", true, 1, -2), touch("2", true, 3, -4), touch("3", false, 0, 0)}, 9);
  EXPECT_THAT(table, HasSubstr("<th scope=\"row\">1</th><td>100.0</td><td>200.0</td><td>101.0</td><td>198.0</td>"
                               "<td>+1.0</td><td>-2.0</td><td>2.2</td>"));
  EXPECT_THAT(table, HasSubstr("<td>2.00</td><td>-3.00</td>"));  // means
  EXPECT_THAT(table, HasSubstr("<td>1.41</td><td>1.41</td>"));   // standard deviations
  EXPECT_THAT(table, HasSubstr("missed"));
}

TEST(TouchesTable, KeepsTheWorstOfVeryMany) {
  const std::string table =
      touches_table({touch("good", true, 1, 1), touch("worst", false, 0, 0), touch("bad", true, 40, 0)}, 2);
  EXPECT_THAT(table, Not(HasSubstr("good")));
  EXPECT_LT(table.find("worst"), table.find("bad<"));
}

}  // namespace
}  // namespace telehug
