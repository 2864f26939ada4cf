// SPDX-License-Identifier: Apache-2.0
#include "capture/rig_directory.hpp"

#include <gmock/gmock.h>

#include "doubles/temporary_folder.hpp"

namespace telehug {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr const char* good_rig = "width_mm = 380\nheight_mm = 300.5\nresolution = [1280, 1024]\n";
constexpr const char* truth_header = "frame,contact,x_mm,y_mm,hover_mm,hand,tone,screen,notes\n";

std::string fault_of(const TemporaryFolder& folder) {
  const auto rig = open_rig_directory(folder.path());
  return rig.ok() ? "" : rig.error().message;
}

TEST(RigDirectory, OpensTheSamples) {
  const auto rig = open_rig_directory(TELEHUG_FIXTURES "/rig2");
  ASSERT_TRUE(rig) << rig.error().message;
  EXPECT_EQ(rig->screen.width_mm, 408);
  EXPECT_EQ(rig->screen.height_mm, 255);
  EXPECT_EQ(rig->screen.width_px, 1440);
  EXPECT_EQ(rig->screen.height_px, 900);
  EXPECT_TRUE(rig->background.has_value());
  EXPECT_FALSE(rig->triangle.has_value());
  ASSERT_GE(rig->calibration.size(), 2u);
  EXPECT_EQ(rig->calibration[0].frame.name, "01");
  EXPECT_EQ(rig->calibration[0].screen.y_mm, 193.40);
  EXPECT_EQ(rig->part("hard"), nullptr);

  const RigPart* sequence = rig->part("sequence");
  ASSERT_NE(sequence, nullptr);
  ASSERT_EQ(sequence->frames.size(), 14u);
  EXPECT_EQ(sequence->frames.front().name, "005");
  EXPECT_EQ(sequence->frames.back().name, "018");
  ASSERT_EQ(sequence->times.size(), 14u);
  EXPECT_EQ(sequence->times[1] - sequence->times[0], 100ms);
  ASSERT_EQ(sequence->truth.size(), 14u);
  EXPECT_FALSE(sequence->truth[0].contact);
  EXPECT_EQ(sequence->truth[0].hover_mm, 19.3);
  EXPECT_TRUE(sequence->truth[2].contact);
  EXPECT_EQ(sequence->truth[2].screen->x_mm, 263.42);
  EXPECT_FALSE(sequence->truth[2].hover_mm.has_value());
  EXPECT_EQ(sequence->truth[2].hand, "left");
  EXPECT_EQ(sequence->truth[2].tone, "II");
  EXPECT_EQ(sequence->truth[2].screen_picture, "chat2");
  EXPECT_EQ(sequence->truth[2].notes, "touch");
}

TEST(RigDirectory, NeedsNothingButTheScreen) {
  const TemporaryFolder folder;
  folder.write("rig.toml", good_rig);
  const auto rig = open_rig_directory(folder.path());
  ASSERT_TRUE(rig) << rig.error().message;
  EXPECT_EQ(rig->screen.height_mm, 300.5);
  EXPECT_TRUE(rig->calibration.empty());
  EXPECT_TRUE(rig->parts.empty());
  EXPECT_FALSE(rig->marks.has_value());
}

TEST(RigDirectory, NamesThePicturesOfTheEmptyRig) {
  const TemporaryFolder folder;
  folder.write("rig.toml", good_rig);
  folder.write("background.jpg", "");
  folder.write("triangle.png", "");
  folder.write("marks.jpg", "");
  const auto rig = open_rig_directory(folder.path());
  ASSERT_TRUE(rig) << rig.error().message;
  EXPECT_EQ(rig->background, folder.path() / "background.jpg");
  EXPECT_EQ(rig->triangle, folder.path() / "triangle.png");
  EXPECT_EQ(rig->marks, folder.path() / "marks.jpg");
}

TEST(RigDirectory, SaysThatAFolderIsMissing) {
  const auto rig = open_rig_directory("/nonexistent-recording");
  ASSERT_FALSE(rig);
  EXPECT_THAT(rig.error().message, HasSubstr("/nonexistent-recording:1:"));
}

TEST(RigDirectory, NamesFileAndLineOfEveryFaultInTheScreen) {
  const TemporaryFolder folder;
  folder.write("rig.toml", "width_mm = -5\n\nheight_mm = \"tall\"\nresolution = [1280]\n");
  EXPECT_THAT(fault_of(folder), AllOf(HasSubstr("rig.toml:1: width_mm"), HasSubstr("rig.toml:3: height_mm"),
                                      HasSubstr("rig.toml:4: resolution")));
  folder.write("rig.toml", "width_mm = 5\nheight_mm = = 7\n");
  EXPECT_THAT(fault_of(folder), HasSubstr("rig.toml:2:"));
  folder.write("rig.toml", "width_mm = 5\n");
  EXPECT_THAT(fault_of(folder), AllOf(HasSubstr("rig.toml:1: height_mm"), HasSubstr("rig.toml:1: resolution")));
}

TEST(RigDirectory, RefusesALineOfAHundredThousandTablesOfTheScreen) {
  const TemporaryFolder folder;
  std::string key = "a";  // toml++ takes tables within tables apart recursively
  for (int i = 0; i < 100'000; ++i)
    key += ".a";
  folder.write("rig.toml", key + " = 1\n");
  EXPECT_THAT(fault_of(folder), HasSubstr("line 1 is longer"));
}

TEST(RigDirectory, SaysThatTheScreensFileIsMissing) {
  const TemporaryFolder folder;
  EXPECT_THAT(fault_of(folder), HasSubstr("rig.toml:1: the file can't be read"));
}

TEST(RigDirectory, NamesFileAndLineOfEveryFaultInTheCalibration) {
  const TemporaryFolder folder;
  folder.write("rig.toml", good_rig);
  folder.write("calibration/01.jpg", "");
  folder.write("calibration.csv",
               "frame,x_mm,y_mm\n01,190,208\n02,220,264\n01,here,264\n01,1\n01,400,100\n\n01,nan,5\n");
  EXPECT_THAT(fault_of(folder),
              AllOf(HasSubstr("calibration.csv:3: there is no picture calibration/02.jpg"),
                    HasSubstr("calibration.csv:4: x_mm is 'here'"), HasSubstr("calibration.csv:5: 2 values"),
                    HasSubstr("calibration.csv:6: the point (400, 100) mm is not on the screen"),
                    HasSubstr("calibration.csv:8: x_mm is 'nan'")));
}

TEST(RigDirectory, NamesFileAndLineOfEveryFaultInTheTruth) {
  const TemporaryFolder folder;
  folder.write("rig.toml", good_rig);
  folder.write("frames/1.jpg", "");
  folder.write("truth.csv", std::string(truth_header) + "1,1,,,,left,I,black,touch\n1,2,5,5,,,,,\n1,0,5,5,-3,,,,\n" +
                                "9,0,,,,,,,\n");
  EXPECT_THAT(fault_of(folder), AllOf(HasSubstr("truth.csv:2: x_mm is ''"), HasSubstr("truth.csv:3: contact is '2'"),
                                      HasSubstr("truth.csv:4: hover_mm is negative"),
                                      HasSubstr("truth.csv:5: there is no picture frames/9.jpg")));
  folder.write("truth.csv", "frame,contact\n1,0\n");
  EXPECT_THAT(fault_of(folder), HasSubstr("truth.csv:1: column 'x_mm' is missing"));
}

TEST(RigDirectory, WantsATimeForEveryPictureAndThatTimesRise) {
  const TemporaryFolder folder;
  folder.write("rig.toml", good_rig);
  for (const char* name : {"sequence/1.jpg", "sequence/2.jpg", "sequence/3.jpg"})
    folder.write(name, "");
  folder.write("times.csv", "frame,monotonic_ns\n1,1000\n2,900\n");
  EXPECT_THAT(fault_of(folder), AllOf(HasSubstr("times.csv:1: picture 2 is not later"),
                                      HasSubstr("times.csv:1: no line tells the time of picture 3")));
  folder.write("times.csv", "frame,monotonic_ns\n1,1000\n2,2000\n3,3.5\n");
  EXPECT_THAT(fault_of(folder), HasSubstr("times.csv:4: monotonic_ns is '3.5'"));
}

TEST(RigDirectory, SaysThatAPartIsEmpty) {
  const TemporaryFolder folder;
  folder.write("rig.toml", good_rig);
  folder.write("hard/truth.csv", truth_header);
  EXPECT_THAT(fault_of(folder), HasSubstr("hard:1: the folder holds no .jpg or .png picture"));
}

TEST(RigDirectory, ReadsColumnsByNameAndLinesThatEndAsOnWindows) {
  const TemporaryFolder folder;
  folder.write("rig.toml", good_rig);
  folder.write("calibration/01.png", "");
  folder.write("calibration.csv", "y_mm, x_mm, remark, frame\r\n20, 10, none, 01\r\n");
  const auto rig = open_rig_directory(folder.path());
  ASSERT_TRUE(rig) << rig.error().message;
  ASSERT_EQ(rig->calibration.size(), 1u);
  EXPECT_EQ(rig->calibration[0].screen.x_mm, 10);
  EXPECT_EQ(rig->calibration[0].screen.y_mm, 20);
}

}  // namespace
}  // namespace telehug
