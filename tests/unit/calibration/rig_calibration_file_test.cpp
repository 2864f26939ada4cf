// SPDX-License-Identifier: Apache-2.0
//
// The calibration file of the default model.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "calibration/calibration_file.hpp"
#include "doubles/random_rig.hpp"
#include "doubles/temporary_folder.hpp"

namespace telehug {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class RigCalibrationFile : public testing::Test {
 protected:
  RigCalibrationFile() {
    const KnownRig rig{{380, 300, 1280, 1024},
                       {RigCamera({1000, 0.03, {195, -15, 50}, 1, -1, 2}, {1280, 720}, {true, true}), 12}};
    RandomRigs random(51);
    RigObservations seen = random.observe(rig, 6, 0.3, 0.3);
    seen.touches[1].evidence = TouchEvidence::contact;
    seen.touches[1].image = rig.model.camera.project(seen.touches[1].screen).value();
    seen.touches[5].image.u_px += 80;
    seen.touches[5].left_out = true;
    seen.marks.push_back({{190, 300}, rig.model.camera.project(ScreenPoint{190, 300}).value(), 2, 3});
    const RigSolution solution = solve_rig(seen).value();
    calibration = Calibration{"webcam \"desk\"",
                              "2026-01-02T03:04:05Z",
                              {1280, 720},
                              rig.screen,
                              border_line(solution.model.camera, rig.screen),
                              RigCalibration{seen, solution}};
  }

  [[nodiscard]] std::string text() const {
    std::ostringstream content;
    content << std::ifstream(file).rdbuf();
    return content.str();
  }

  // Writes a good file in which the line of `key` after `section` has another value.
  void write_with(const std::string& section, const std::string& key, const std::string& value) {
    ASSERT_TRUE(write_calibration(file, *calibration).ok());
    std::string changed = text();
    const auto begin = changed.find(key + " = ", changed.find("[" + section + "]"));
    ASSERT_NE(begin, std::string::npos) << changed;
    changed.replace(begin, changed.find('\n', begin) - begin, key + " = " + value);
    std::ofstream(file) << changed;
  }

  // The number of the first line with this text.
  [[nodiscard]] std::string line_of(const std::string& part) const {
    const std::string all = text();
    return std::to_string(1 + std::count(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(all.find(part)), '\n'));
  }

  [[nodiscard]] std::string fault() const {
    const auto read = read_calibration(file);
    return read.ok() ? "it was read" : read.error().message;
  }

  TemporaryFolder folder;
  std::filesystem::path file = folder.path() / "rig.toml";
  std::optional<Calibration> calibration;
};

TEST_F(RigCalibrationFile, GivesBackAllThatWasWritten) {
  ASSERT_TRUE(write_calibration(file, *calibration).ok());
  const auto read = read_calibration(file);
  ASSERT_TRUE(read.ok()) << read.error().message;
  EXPECT_STREQ(read->model_name(), "default");
  EXPECT_EQ(read->camera, calibration->camera);
  EXPECT_DOUBLE_EQ(read->border.v0_px, calibration->border.v0_px);
  const auto& was = std::get<RigCalibration>(calibration->solved);
  const auto& is = std::get<RigCalibration>(read->solved);
  ASSERT_EQ(is.observations.touches.size(), 6U);
  for (std::size_t i = 0; i < is.observations.touches.size(); ++i) {
    EXPECT_EQ(is.observations.touches[i].evidence, was.observations.touches[i].evidence) << i;
    EXPECT_EQ(is.observations.touches[i].left_out, i == 5) << i;
  }
  EXPECT_DOUBLE_EQ(is.observations.touches[3].image.v_px, was.observations.touches[3].image.v_px);
  ASSERT_EQ(is.observations.marks.size(), 1U);
  EXPECT_DOUBLE_EQ(is.observations.marks[0].sigma_v_px, 3);
  EXPECT_EQ(is.observations.border.size(), was.observations.border.size());
  for (std::size_t i = 0; i < RigParameter::count; ++i)
    EXPECT_DOUBLE_EQ(is.solution.parameters[i], was.solution.parameters[i]) << i;
  EXPECT_EQ(is.solution.model.camera.orientation(), (PictureOrientation{true, true}));
  EXPECT_NEAR(is.solution.covariance[0][0], was.solution.covariance[0][0], 1e-3 * was.solution.covariance[0][0]);
}

TEST_F(RigCalibrationFile, ShowsTheResiduals) {
  ASSERT_TRUE(write_calibration(file, *calibration).ok());
  EXPECT_THAT(text(), AllOf(HasSubstr("error_x_mm"), HasSubstr("error_y_mm"), HasSubstr("version = 2")));
}

TEST_F(RigCalibrationFile, IsRefusedIfItsParametersContradictItsTouches) {
  write_with("parameters", "z0_mm", "60.0");
  EXPECT_THAT(fault(), AllOf(HasSubstr("rig.toml:" + line_of("[parameters]") + ": "), HasSubstr("do not follow")));
  write_with("screen", "height_mm", "315.0");
  EXPECT_THAT(fault(), HasSubstr("do not follow"));
}

TEST_F(RigCalibrationFile, TellsTheLineOfAWrongValue) {
  write_with("[touch]", "sigma_u_px", "-1");
  EXPECT_THAT(fault(), HasSubstr("rig.toml:" + line_of("sigma_u_px = -1") + ": sigma_u_px must be a number"));
  write_with("parameters", "left_right_exchanged", "3");
  EXPECT_THAT(fault(), HasSubstr("left_right_exchanged must be true or false"));
}

TEST_F(RigCalibrationFile, IsRefusedWithoutTouches) {
  ASSERT_TRUE(write_calibration(file, *calibration).ok());
  const std::string all = text();
  std::ofstream(file) << all.substr(0, all.find("[[touch]]"));
  EXPECT_THAT(fault(), AllOf(HasSubstr("rig.toml: "), HasSubstr("too few")));
}

}  // namespace
}  // namespace telehug
