// SPDX-License-Identifier: Apache-2.0
#include "calibration/calibration_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>

#include "doubles/aligned_rig.hpp"

namespace telehug {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

class CalibrationFile : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "telehug-calibration-XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
    file_ = folder_ / "rig.toml";
  }
  void TearDown() override { fs::remove_all(folder_); }

  static Calibration calibration() {
    const AlignedRig rig{{380, 300, 1280, 1024}, 187, -8, 950.0 * 40, -950};
    const MeasuredTouch first = rig.project({190, 100});
    const MeasuredTouch second = rig.project({220, 220});
    return {"webcam \"desk\"",
            "2026-01-02T03:04:05Z",
            {1280, 720},
            rig.screen,
            {512.25, -0.0175},
            ThesisCalibration{{first, second}, ThesisTouchModel::solve(rig.screen, first, second).value()}};
  }

  [[nodiscard]] std::string text() const {
    std::ostringstream content;
    content << std::ifstream(file_).rdbuf();
    return content.str();
  }

  // Writes a good file with one piece of its text replaced.
  void write_with(const std::string& piece, const std::string& replacement) {
    ASSERT_TRUE(write_calibration(file_, calibration()).ok());
    std::string changed = text();
    const auto at = changed.find(piece);
    ASSERT_NE(at, std::string::npos) << piece << " in " << changed;
    changed.replace(at, piece.size(), replacement);
    std::ofstream(file_) << changed;
  }

  [[nodiscard]] std::string fault() const {
    const auto read = read_calibration(file_);
    return read.ok() ? "it was read" : read.error().message;
  }

  fs::path folder_;
  fs::path file_;
};

TEST_F(CalibrationFile, GivesBackAllThatWasWritten) {
  const Calibration written = calibration();
  ASSERT_TRUE(write_calibration(file_, written).ok());
  const auto read = read_calibration(file_);
  ASSERT_TRUE(read.ok()) << read.error().message;
  EXPECT_EQ(read->camera, written.camera);
  EXPECT_EQ(read->date, written.date);
  EXPECT_EQ(read->image.width_px, 1280);
  EXPECT_EQ(read->image.height_px, 720);
  EXPECT_DOUBLE_EQ(read->screen.width_mm, 380);
  EXPECT_DOUBLE_EQ(read->screen.height_mm, 300);
  EXPECT_EQ(read->screen.width_px, 1280);
  EXPECT_EQ(read->screen.height_px, 1024);
  EXPECT_DOUBLE_EQ(read->border.v0_px, 512.25);
  EXPECT_DOUBLE_EQ(read->border.slope, -0.0175);
  const auto& touch = std::get<ThesisCalibration>(read->solved).touches[1];
  const auto& written_touch = std::get<ThesisCalibration>(written.solved).touches[1];
  EXPECT_DOUBLE_EQ(touch.length_px, written_touch.length_px);
  EXPECT_DOUBLE_EQ(touch.column_px, written_touch.column_px);
  EXPECT_DOUBLE_EQ(read->camera_below_top_mm(), written.camera_below_top_mm());
}

TEST_F(CalibrationFile, LeavesNothingBesideIt) {
  ASSERT_TRUE(write_calibration(file_, calibration()).ok());
  ASSERT_TRUE(write_calibration(file_, calibration()).ok());
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1);
}

TEST_F(CalibrationFile, MakesItsFolder) {
  file_ = folder_ / "state" / "telehug" / "rig.toml";
  ASSERT_TRUE(write_calibration(file_, calibration()).ok());
  EXPECT_TRUE(read_calibration(file_).ok());
}

TEST_F(CalibrationFile, MayLackThePixelsOfTheScreen) {
  Calibration without = calibration();
  without.screen.width_px = without.screen.height_px = 0;
  ASSERT_TRUE(write_calibration(file_, without).ok());
  const auto read = read_calibration(file_);
  ASSERT_TRUE(read.ok()) << read.error().message;
  EXPECT_EQ(read->screen.width_px, 0);
}

TEST_F(CalibrationFile, SaysWhyItCouldNotBeWritten) {
  std::ofstream(folder_ / "file") << "no folder";
  const auto written = write_calibration(folder_ / "file" / "rig.toml", calibration());
  ASSERT_FALSE(written.ok());
  EXPECT_THAT(written.error().message, HasSubstr("Not a directory"));
}

TEST_F(CalibrationFile, SaysThatThereIsNone) {
  EXPECT_THAT(fault(), HasSubstr("can't be read"));
}

// toml++ takes tables within tables apart recursively.
TEST_F(CalibrationFile, IsRefusedWithALineOfAHundredThousandTables) {
  std::string key = "a";
  for (int i = 0; i < 100'000; ++i)
    key += ".a";
  std::ofstream(file_) << "version = 1\n" << key << " = 1\n";
  EXPECT_THAT(fault(), HasSubstr("line 2 is longer"));
}

TEST_F(CalibrationFile, TellsTheLineOfATextThatIsNoToml) {
  std::ofstream(file_) << "version = 1\ncamera = \n";
  EXPECT_THAT(fault(), HasSubstr("rig.toml:2: "));
}

TEST_F(CalibrationFile, TellsAllFaultsAtOnceWithTheirLines) {
  std::ofstream(file_) << "version = 1\ncamera = 'x'\ndate = ''\nmodel = 'guess'\n"
                          "[image]\nwidth_px = 1280\nheight_px = 0\n"
                          "[screen]\nwidth_mm = -3\nheight_mm = nan\nwidth_px = 1920\nheight_px = 1080\n"
                          "[border]\nv0_px = 500\n"
                          "[[touch]]\nx_mm = 1\n";
  EXPECT_THAT(fault(), AllOf(HasSubstr("rig.toml:3: date must be"), HasSubstr("rig.toml:4: model \"guess\" is unknown"),
                             HasSubstr("rig.toml:7: height_px must be"), HasSubstr("rig.toml:9: width_mm must be"),
                             HasSubstr("rig.toml:10: height_mm must be"), HasSubstr("rig.toml:13: slope must be"),
                             HasSubstr("there must be two [[touch]] sections")));
}

TEST_F(CalibrationFile, IsRefusedIfItIsNewerThanTheProgram) {
  write_with("version = 1", "version = 3");
  EXPECT_THAT(fault(), HasSubstr("newer than this program"));
}

TEST_F(CalibrationFile, IsRefusedIfItsTouchesDoNotSolve) {
  write_with("y_mm = 220", "y_mm = 100");
  EXPECT_THAT(fault(), AllOf(HasSubstr("rig.toml: calibration touch 2"), HasSubstr("as high as the first")));
}

TEST_F(CalibrationFile, IsRefusedIfASectionIsMissing) {
  write_with("[border]", "[edge]");
  EXPECT_THAT(fault(), HasSubstr("the section [border] is missing"));
}

}  // namespace
}  // namespace telehug
