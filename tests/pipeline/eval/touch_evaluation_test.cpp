// SPDX-License-Identifier: Apache-2.0
//
// What `eval touch` says of wrong options, incomplete recordings and damaged pictures.
#include "eval/touch_eval.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "doubles/temporary_folder.hpp"
#include "eval/error_table.hpp"

namespace telehug {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class TouchEvaluation : public testing::Test {
 protected:
  static std::string fault(const EvalTouchOptions& options) {
    const auto report = eval_touch(options);
    return report.ok() ? "it was evaluated" : report.error().message;
  }

  EvalTouchOptions options_ = [] {
    EvalTouchOptions options;
    options.rig = TELEHUG_FIXTURES "/rig2";
    return options;
  }();
};

TEST_F(TouchEvaluation, NamesTheUnknownChoice) {
  options_.algorithm.detector = "magic";
  EXPECT_THAT(fault(options_), HasSubstr("--detector magic is unknown"));
  options_.algorithm.detector = "thesis";
  options_.algorithm.model = "magic";
  EXPECT_THAT(fault(options_), HasSubstr("--model magic is unknown"));
}

TEST_F(TouchEvaluation, NamesTheMissingPart) {
  options_.part = "hard";
  EXPECT_THAT(fault(options_), HasSubstr("has no part \"hard\""));
}

TEST_F(TouchEvaluation, NamesTheMissingCalibrationTouch) {
  options_.calibration = {1, 77};
  EXPECT_THAT(fault(options_), HasSubstr("has no calibration touch 77"));
}

TEST_F(TouchEvaluation, WantsTwoCalibrationTouches) {
  options_.algorithm.model = "thesis";
  options_.calibration = {1, 2, 4};
  EXPECT_THAT(fault(options_), HasSubstr("calibrated with 2 touches, not 3"));
}

TEST_F(TouchEvaluation, NamesTheFileThatCanNotBeWritten) {
  options_.out = "/no/such/folder/touches.csv";
  EXPECT_THAT(fault(options_), HasSubstr("can't write /no/such/folder/touches.csv"));
}

TEST_F(TouchEvaluation, NamesTheCalibrationPictureWithoutAFinger) {
  const TemporaryFolder folder;
  fs::copy(options_.rig, folder / "rig", fs::copy_options::recursive);
  fs::copy(folder / "rig/background.jpg", folder / "rig/calibration/02.jpg", fs::copy_options::overwrite_existing);
  options_.algorithm.model = "thesis";
  options_.rig = folder / "rig";
  EXPECT_THAT(fault(options_), HasSubstr("calibration/02.jpg: no finger crosses"));
}

TEST_F(TouchEvaluation, GoesOnAfterADamagedPicture) {
  const TemporaryFolder folder;
  fs::copy(options_.rig, folder / "rig", fs::copy_options::recursive);
  fs::resize_file(folder / "rig/frames/012.jpg", 2000);
  options_.rig = folder / "rig";
  const auto report = eval_touch(options_);
  ASSERT_TRUE(report.ok()) << report.error().message;
  ASSERT_EQ(report->part.unreadable.size(), 1U);
  EXPECT_THAT(report->part.unreadable[0], HasSubstr("012.jpg"));
  EXPECT_EQ(report->part.found.size(), 2U);
  EXPECT_THAT(format_error_table(*report), HasSubstr("not used: "));
}

TEST_F(TouchEvaluation, TellsContactsOfARecordingThatEndsEarlyAndHasNoTruth) {
  const TemporaryFolder folder;
  fs::copy(options_.rig, folder / "rig", fs::copy_options::recursive);
  fs::remove(folder / "rig/sequence/truth.csv");
  fs::remove(folder / "rig/sequence/times.csv");
  for (const char* frame : {"013", "014", "015", "016", "017", "018"})
    fs::remove(folder / "rig/sequence" / (std::string(frame) + ".jpg"));
  options_.rig = folder / "rig";
  options_.part = "sequence";
  const auto report = eval_touch(options_);
  ASSERT_TRUE(report.ok()) << report.error().message;
  ASSERT_EQ(report->part.contacts.size(), 1U);
  EXPECT_EQ(report->part.contacts.front().up, "");
  EXPECT_THAT(format_error_table(*report), HasSubstr("contact 1: from frame 007 on\n"));
}

}  // namespace
}  // namespace telehug
