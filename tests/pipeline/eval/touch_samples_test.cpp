// SPDX-License-Identifier: Apache-2.0
//
// The thesis' algorithm and the default on pictures of two rigs: the fixtures always, the whole samples where they lie
// beside the project (../shared/touch-samples).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <opencv2/core.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "calibration/border_candidates.hpp"
#include "calibration/calibration_dot.hpp"
#include "calibration/calibration_file.hpp"
#include "calibration/calibration_policy.hpp"
#include "calibration/drift_watch.hpp"
#include "calibration/screen_border.hpp"
#include "capture/rig_directory.hpp"
#include "doubles/temporary_folder.hpp"
#include "eval/error_statistics.hpp"
#include "eval/error_table.hpp"
#include "eval/rig_calibration.hpp"
#include "eval/touch_eval.hpp"
#include "finger/thesis_detector.hpp"
#include "pictures/picture_file.hpp"

namespace telehug {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::MatchesRegex;
using testing::StartsWith;

std::vector<fs::path> sample_folders() {
  std::vector<fs::path> folders{TELEHUG_FIXTURES};
  const fs::path whole = TELEHUG_SOURCE "/../shared/touch-samples";
  if (fs::exists(whole / "rig1")) folders.push_back(whole);
  return folders;
}

std::string folder_name(const testing::TestParamInfo<fs::path>& info) {
  return info.index == 0 ? "Fixtures" : "WholeSamples";
}

std::vector<std::string> lines_of(const fs::path& file) {
  std::ifstream stream(file);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);)
    lines.push_back(line);
  return lines;
}

class TouchSamples : public testing::TestWithParam<fs::path> {
 protected:
  static EvalTouchReport eval(const EvalTouchOptions& options) {
    auto report = eval_touch(options);
    if (!report) throw std::runtime_error(report.error().message);
    return *std::move(report);
  }

  static EvalTouchOptions options(const char* rig, const char* part) {
    EvalTouchOptions options;
    options.rig = GetParam() / rig;
    options.part = part;
    options.algorithm = thesis_algorithm;
    return options;
  }
};

// The lines were read off pictures with a white screen.
TEST_P(TouchSamples, ShowTheBorderInBothRigs) {
  const auto picture1 = read_picture(GetParam() / "rig1" / "background.jpg");
  const auto picture2 = read_picture(GetParam() / "rig2" / "background.jpg");
  ASSERT_TRUE(picture1.ok() && picture2.ok());
  const auto border1 = find_screen_border(*picture1, BorderChoice::longest);
  const auto border2 = find_screen_border(*picture2, BorderChoice::longest);
  ASSERT_TRUE(border1.ok() && border2.ok());
  // In rig 1 the screen is a mirror and black: the longest line is the mirror image of the bezel.
  EXPECT_NEAR(border1->line.v_at(640), 523.8, 10);
  EXPECT_NEAR(border1->line.slope, 0.0074, 0.003);
  EXPECT_NEAR(border2->line.v_at(640), 543.4, 1.5);
  EXPECT_NEAR(border2->line.slope, -0.018, 0.002);
}

TEST_P(TouchSamples, CalibrateBothRigsWithTwoTouches) {
  for (const char* name : {"rig1", "rig2"}) {
    const auto rig = open_rig_directory(GetParam() / name);
    ASSERT_TRUE(rig.ok()) << rig.error().message;
    const auto calibration = calibrate_from_recording(*rig, "thesis", {}, "2026-01-01T00:00:00Z");
    ASSERT_TRUE(calibration.ok()) << calibration.error().message;
    // The pictures are mirrored: right is the user's left.
    EXPECT_LT(std::get<ThesisCalibration>(calibration->solved).model.horizontal_scale_px(), 0);
    const TemporaryFolder folder;
    ASSERT_TRUE(write_calibration(folder / "rig.toml", *calibration).ok());
    const auto read = read_calibration(folder / "rig.toml");
    ASSERT_TRUE(read.ok()) << read.error().message;
    EXPECT_DOUBLE_EQ(read->camera_below_top_mm(), calibration->camera_below_top_mm());
  }
}

// The edge that the thesis' way does not find in rig 1 is there, measured along the lens' curve.
TEST_P(TouchSamples, HoldTheScreensOwnEdgeAmongTheCandidates) {
  for (const auto& [name, row] : {std::pair{"rig1", 523.8}, {"rig2", 543.4}}) {
    const auto picture = read_picture(GetParam() / name / "background.jpg");
    ASSERT_TRUE(picture.ok());
    const BorderLine level = find_screen_border(*picture, BorderChoice::longest)->line;
    double nearest_px = 100;
    for (const BorderCandidate& candidate : find_border_candidates(*picture, level)) {
      double off = 0;
      for (const BorderObservation& point : candidate.points)
        off += (point.image.v_px - level.v_at(point.image.u_px)) / static_cast<double>(candidate.points.size());
      nearest_px = std::min(nearest_px, std::abs(off + level.v_at(640) - row));
    }
    EXPECT_LT(nearest_px, 1) << name;
  }
}

TEST_P(TouchSamples, CalibrateTheDefaultModelWithAllTouches) {
  for (const char* name : {"rig1", "rig2"}) {
    const auto rig = open_rig_directory(GetParam() / name);
    ASSERT_TRUE(rig.ok()) << rig.error().message;
    const auto calibration = calibrate_from_recording(*rig, "default", {}, "2026-01-01T00:00:00Z");
    ASSERT_TRUE(calibration.ok()) << calibration.error().message;
    const auto& solved = std::get<RigCalibration>(calibration->solved);
    EXPECT_EQ(solved.solution.model.camera.orientation(), PictureOrientation{}) << name;
    EXPECT_NEAR(calibration->camera_below_top_mm(), 0, 40) << name;
    EXPECT_TRUE(judge_calibration(solved, {}).good()) << name;
    const TemporaryFolder folder;
    ASSERT_TRUE(write_calibration(folder / "rig.toml", *calibration).ok());
    EXPECT_TRUE(read_calibration(folder / "rig.toml").ok());
  }
}

// A dot is a point of the screen: what the camera makes of it is exact to parts of a millimetre, though the dots' light
// floods the fingertips and glossy screens mirror them.
TEST_P(TouchSamples, ShowTheDotsUnderTheFingers) {
  for (const auto& [name, vertical_mm] : {std::pair{"rig1", 0.3}, {"rig2", 0.15}}) {
    const auto rig = open_rig_directory(GetParam() / name);
    ASSERT_TRUE(rig.ok()) << rig.error().message;
    const auto calibration = calibrate_from_recording(*rig, "default", {}, "");
    ASSERT_TRUE(calibration.ok()) << calibration.error().message;
    const auto& solved = std::get<RigCalibration>(calibration->solved);
    ASSERT_EQ(solved.observations.touches.size(), rig->calibration.size()) << name;
    double horizontal = 0, vertical = 0;
    for (std::size_t i = 0; i < rig->calibration.size(); ++i) {
      EXPECT_EQ(solved.observations.touches[i].evidence, TouchEvidence::dot) << name << " " << i;
      horizontal += std::abs(solved.solution.touches[i].error_mm.x_mm) / static_cast<double>(rig->calibration.size());
      vertical += std::abs(solved.solution.touches[i].error_mm.y_mm) / static_cast<double>(rig->calibration.size());
    }
    EXPECT_LT(horizontal, 0.1) << name;
    EXPECT_LT(vertical, vertical_mm) << name;
    EXPECT_FALSE(solved.solution.bad_touch.has_value()) << name;
  }
}

TEST_P(TouchSamples, ShowNoDotsWhenTheScreenIsBlack) {
  for (const char* name : {"rig1", "rig2"}) {
    const auto background = read_picture(GetParam() / name / "background.jpg");
    ASSERT_TRUE(background.ok());
    const BorderLine level = find_screen_border(*background, BorderChoice::longest)->line;
    EXPECT_FALSE(find_calibration_dot(*background, level).has_value()) << name;
  }
}

// Whatever the screens show and whoever is in the way: the camera of a recording stands still.
TEST_P(TouchSamples, NeverLookAsIfTheCameraHadMoved) {
  for (const char* name : {"rig1", "rig2"}) {
    const auto rig = open_rig_directory(GetParam() / name);
    ASSERT_TRUE(rig.ok()) << rig.error().message;
    const auto calibration = calibrate_from_recording(*rig, "default", {}, "").value();
    const RigModel model = std::get<RigModel>(calibration.model());
    BorderMeasurer measurer(model.camera, calibration.screen);
    ASSERT_TRUE(measurer.learn(read_picture(*rig->background).value()));
    for (const RigPart& part : rig->parts) {
      DriftWatch watch(model.camera, calibration.screen);
      Timestamp now{};
      for (const RigFrame& frame : part.frames) {
        const BorderShifts shifts = measurer.measure(read_picture(frame.picture).value());
        for (int tenth = 0; tenth < 20; ++tenth, now += 100ms)
          EXPECT_EQ(watch.update(shifts, now).state, DriftState::steady) << name << " " << part.name << frame.name;
      }
    }
  }
}

// With the screen lit and a triangle on it, the border is the screen's own edge, not its mirror image.
TEST_P(TouchSamples, GiveTheScreensOwnEdgeWithATriangle) {
  const BorderLine edge{519.1, 0.0074};
  const TemporaryFolder folder;
  fs::copy(GetParam() / "rig1", folder / "rig", fs::copy_options::recursive);
  auto picture = read_picture(folder / "rig/background.jpg");
  ASSERT_TRUE(picture.ok());
  for (int u = 0; u < picture->cols; ++u) {
    for (int v = static_cast<int>(edge.v_at(u)) + 1; v < picture->rows; ++v) {
      const bool in_triangle = std::abs(u - 700) < 2 * (v - edge.v_at(u)) && v - edge.v_at(u) < 100;
      picture->at<cv::Vec3b>(v, u) = cv::Vec3b::all(in_triangle ? 12 : 235);
    }
  }
  ASSERT_TRUE(write_png(folder / "rig/triangle.png", *picture).ok());
  const auto rig = open_rig_directory(folder / "rig");
  ASSERT_TRUE(rig.ok()) << rig.error().message;
  const auto calibration = calibrate_from_recording(*rig, "thesis", {}, "2026-01-01T00:00:00Z");
  ASSERT_TRUE(calibration.ok()) << calibration.error().message;
  EXPECT_NEAR(calibration->border.v_at(100), edge.v_at(100), 2);
  EXPECT_NEAR(calibration->border.v_at(1200), edge.v_at(1200), 2);
  // The camera sits near the screen's top edge.
  EXPECT_NEAR(calibration->camera_below_top_mm(), 0, 60);
}

TEST_P(TouchSamples, HoldASlidingFingerThatIsFound) {
  const EvalTouchReport report = eval(options("rig2", "sequence"));
  ASSERT_TRUE(report.score.has_value());
  EXPECT_EQ(report.score->touches.size(), 10U);
  std::size_t near = 0;
  for (const ScoredTouch& touch : report.score->touches) {
    near += touch.near() ? 1U : 0U;
  }
  EXPECT_GE(near, 9U) << format_error_table(report);
}

TEST_P(TouchSamples, HoldOneContactThatBeginsAndEndsWithinAFrameOfTheTruth) {
  for (const char* name : {"rig1", "rig2"}) {
    if (open_rig_directory(GetParam() / name)->part("sequence") == nullptr) continue;
    EvalTouchOptions chosen = options(name, "sequence");
    chosen.algorithm = {};
    const EvalTouchReport report = eval(chosen);
    const auto& touches = report.score->touches;
    ASSERT_EQ(report.part.contacts.size(), 1U) << format_error_table(report);
    const EvaluatedContact& contact = report.part.contacts.front();
    EXPECT_EQ(contact.id, 1U);
    EXPECT_NEAR(std::stoi(contact.down), std::stoi(touches.front().frame), 1) << name;
    EXPECT_NEAR(std::stoi(contact.up), std::stoi(touches.back().frame) + 1, 1) << name;
  }
}

TEST_P(TouchSamples, HoldNoFingerWhereNothingCrossesTheBorder) {
  for (const char* name : {"rig1", "rig2"}) {
    const EvalTouchReport report = eval(options(name, "frames"));
    for (const ScoredRest& rest : report.score->rests) {
      if (rest.kind != "hover") {
        EXPECT_EQ(rest.false_touches.size(), 0U) << name << " " << rest.frame;
      }
    }
  }
}

TEST_P(TouchSamples, AreFollowedFromTheBezelToTheTip) {
  // Read off the picture: the fingertip ends at (662, 587), before the white dot's far edge at 597.
  const auto picture = read_picture(GetParam() / "rig1" / "calibration" / "01.jpg");
  ASSERT_TRUE(picture.ok());
  ThesisDetector detector({519.1, 0.0074}, {picture->cols, picture->rows});
  const Fingers& fingers = detector.detect(*picture);
  ASSERT_EQ(fingers.size(), 1U);
  EXPECT_NEAR(fingers[0].tip.u_px, 662, 8);
  EXPECT_NEAR(fingers[0].tip.v_px, 588, 8);
  EXPECT_NEAR(fingers[0].left_px, 632, 8);
  EXPECT_NEAR(fingers[0].right_px, 700, 8);
}

TEST_P(TouchSamples, BecomeACsvWithOneRowAFingerAndOneAFrameWithout) {
  const TemporaryFolder folder;
  EvalTouchOptions chosen = options("rig2", "frames");
  chosen.out = folder / "touches.csv";
  const EvalTouchReport report = eval(chosen);
  const auto lines = lines_of(chosen.out);
  ASSERT_EQ(lines.size(), report.part.found.size() + 1);  // the thesis finds one finger at most
  EXPECT_EQ(lines[0], "frame,contact,x_mm,y_mm");
  for (std::size_t i = 0; i < report.part.found.size(); ++i) {
    EXPECT_THAT(lines[i + 1], StartsWith(report.part.found[i].frame + ","));
    EXPECT_THAT(lines[i + 1], MatchesRegex("[0-9]+,(0,,|1,-?[0-9]+\\.[0-9][0-9],-?[0-9]+\\.[0-9][0-9])"));
  }
}

TEST_P(TouchSamples, SayWhichDetectorAndModelWereUsed) {
  EvalTouchOptions chosen = options("rig2", "frames");
  chosen.algorithm.detector = "default";
  const std::string table = format_error_table(eval(chosen));
  EXPECT_THAT(table, HasSubstr("detector default, model thesis"));
}

// What the project promises of both rigs, single pictures, two touches at once and sequences taken together. A contact
// may begin a frame late.
TEST_P(TouchSamples, AreFoundByTheDefaultWithinMillimetres) {
  for (const char* const name : {"rig1", "rig2"}) {
    std::vector<double> vertical_mm, horizontal_mm;
    std::size_t late = 0;
    std::size_t false_touches = 0;
    const auto rig = open_rig_directory(GetParam() / name);
    ASSERT_TRUE(rig.ok()) << rig.error().message;
    for (const RigPart& part : rig->parts) {
      EvalTouchOptions chosen = options(name, part.name.c_str());
      chosen.algorithm = {};
      const EvalTouchReport report = eval(chosen);
      const std::vector<ScoredTouch>& touches = report.score->touches;
      for (const ScoredTouch& touch : touches) {
        if (!touch.found) {
          EXPECT_TRUE(part.name == "sequence" && touch.frame == touches.front().frame) << name << " " << touch.frame;
          ++late;
          continue;
        }
        EXPECT_TRUE(touch.near()) << name << " " << part.name << " " << touch.frame;
        vertical_mm.push_back(std::abs(touch.vertical_error_mm));
        horizontal_mm.push_back(std::abs(touch.horizontal_error_mm));
      }
      EXPECT_TRUE(report.score->extras.empty()) << name << " " << part.name;
      for (const ScoredRest& rest : report.score->rests)
        false_touches += rest.kind == "hover" ? 0 : rest.false_touches.size();
    }
    EXPECT_LE(late, 1U) << name;
    EXPECT_LE(mean(vertical_mm), 1.3) << name;
    EXPECT_LE(mean(horizontal_mm), 0.8) << name;
    EXPECT_LE(p95(vertical_mm), 3.2) << name;
    EXPECT_LE(p95(horizontal_mm), 1.9) << name;
    EXPECT_EQ(false_touches, 0U) << name << ": without a hand, or with one that does not cross";
  }
}

INSTANTIATE_TEST_SUITE_P(Both, TouchSamples, testing::ValuesIn(sample_folders()), folder_name);

}  // namespace
}  // namespace telehug
