// SPDX-License-Identifier: Apache-2.0
//
// `eval rigs` and `--report`, from rendered and recorded pictures to the page.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "doubles/temporary_folder.hpp"
#include "eval/rigs_eval.hpp"
#include "eval/rigs_table.hpp"
#include "eval/touch_eval.hpp"
#include "eval_report/html_report.hpp"
#include "eval_report/make_report.hpp"

namespace telehug {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
using testing::StartsWith;

constexpr const char* date = "2026-01-01T00:00:00Z";

TEST(EvalRigs, GivesTheSameForAnyNumberOfJobs) {
  EvalRigsOptions options;
  options.count = 2;
  options.rig.frames = 3;
  options.rig.dots = 2;
  options.rig.algorithms = {{}, thesis_algorithm};
  options.rig.failure_pictures = true;
  std::vector<std::size_t> told;
  const RigsResult alone = eval_rigs(options, [&](std::size_t done) { told.push_back(done); });
  EXPECT_THAT(told, testing::ElementsAre(1, 2));
  options.jobs = 2;
  const RigsResult together = eval_rigs(options, [](std::size_t) {});

  for (const std::size_t algorithm : {0U, 1U})
    EXPECT_EQ(format_rigs_table(options, alone.rigs, algorithm), format_rigs_table(options, together.rigs, algorithm));
  const std::string page = html_report(report_of(options, alone, date));
  EXPECT_EQ(page, html_report(report_of(options, together, date)));
  EXPECT_THAT(page, HasSubstr("Touches of virtual rigs 1 to 2"));
  EXPECT_EQ(summarise(alone.rigs, 0).not_calibrated, 0U);
  for (const RigOutcome& rig : alone.rigs) {
    const AlgorithmOutcome& outcome = rig.algorithms.front();
    // Of two touches one may not be seen: the marks make up for it.
    EXPECT_THAT(outcome.calibration_errors_mm, SizeIs(testing::AllOf(testing::Ge(1U), testing::Le(2U))));
    ASSERT_FALSE(outcome.score.touches.empty());
    EXPECT_THAT(outcome.score.touches.front().frame, StartsWith("frames/"));
    EXPECT_THAT(outcome.score.touches.back().frame, StartsWith("hard/"));
  }
}

TEST(EvalRigs, GoesOnAfterARigThatCanNotBeDrawn) {
  EvalRigsOptions options;
  options.count = 1;
  options.rig.frames = -1;
  const RigsResult result = eval_rigs(options, [](std::size_t) {});
  EXPECT_THAT(result.rigs.at(0).algorithms.at(0).failure, HasSubstr("must not be negative"));
  EXPECT_EQ(summarise(result.rigs, 0).not_calibrated, 1U);
  EXPECT_THAT(html_report(report_of(options, result, date)), HasSubstr("virtual:1 was not calibrated"));
}

TEST(Reports, OfARecordingShowItsTouchesAndFailuresBesideTheThesis) {
  EvalTouchOptions options;
  options.rig = TELEHUG_FIXTURES "/rig2";
  options.part = "sequence";
  options.failure_pictures = true;
  const auto evaluated = eval_touch(options);
  ASSERT_TRUE(evaluated.ok()) << evaluated.error().message;
  options.algorithm = thesis_algorithm;
  const auto thesis = eval_touch(options);
  ASSERT_TRUE(thesis.ok()) << thesis.error().message;

  const Report report = report_of(*evaluated, thesis, date);
  EXPECT_EQ(report.title, "Touches of rig2");
  EXPECT_THAT(report.touches, SizeIs(evaluated->score->touches.size()));
  EXPECT_THAT(report.calibration, SizeIs(4));
  EXPECT_THAT(report.algorithms, SizeIs(2));
  EXPECT_EQ(report.algorithms[1].all.touches, report.algorithms[0].all.touches);
  const TemporaryFolder folder;
  ASSERT_TRUE(write_html_report(folder / "page.html", report).ok());
  std::stringstream page;
  page << std::ifstream(folder / "page.html").rdbuf();
  EXPECT_THAT(page.str(), HasSubstr("detector thesis, model thesis"));
  EXPECT_THAT(page.str(), HasSubstr(report.touches.front().frame));
  EXPECT_FALSE(write_html_report(folder / "none/page.html", report).ok());
}

// The thesis' detector knows no hovering, and so there is something to show.
TEST(Reports, HoldPicturesOfWhatWentWrong) {
  EvalTouchOptions options;
  options.rig = TELEHUG_FIXTURES "/rig2";
  options.algorithm = thesis_algorithm;
  options.failure_pictures = true;
  const auto evaluated = eval_touch(options);
  ASSERT_TRUE(evaluated.ok()) << evaluated.error().message;
  std::size_t failures = evaluated->score->extras.size();
  for (const ScoredTouch& touch : evaluated->score->touches)
    failures += touch.near() ? 0U : 1U;
  for (const ScoredRest& rest : evaluated->score->rests)
    failures += rest.false_touches.size();
  EXPECT_THAT(evaluated->failures, SizeIs(failures));
  for (const FailurePicture& picture : evaluated->failures) {
    EXPECT_GT(picture.jpeg.size(), 1000U);
    EXPECT_TRUE(picture.place_px || picture.found_px) << picture.failure.frame;
  }
  options.failure_pictures = false;
  EXPECT_THAT(eval_touch(options).value().failures, IsEmpty());
}

}  // namespace
}  // namespace telehug
