// SPDX-License-Identifier: Apache-2.0
#include "capture/virtual_rig/export_rig.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <opencv2/core.hpp>
#include <string>

#include "capture/rig_directory.hpp"
#include "capture/virtual_rig/virtual_rig.hpp"
#include "doubles/fake_clock.hpp"
#include "doubles/temporary_folder.hpp"
#include "pictures/picture_file.hpp"

namespace telehug {
namespace {

TEST(ExportedRig, OpensAgainWithItsTruth) {
  const TemporaryFolder folder;
  VirtualRigSettings settings;
  settings.image = {640, 360};
  settings.focal_px = 550;
  settings.script = {{{0.5, 0.8, {170, 200}, {210, 220}}}, 1.3};
  ASSERT_TRUE(export_rig_directory(settings, folder.path(), {.sequence_frames = 30, .single_frames = 4}));

  const auto rig = open_rig_directory(folder.path());
  ASSERT_TRUE(rig) << rig.error().message;
  EXPECT_EQ(rig->screen.width_mm, settings.screen.width_mm);
  EXPECT_EQ(rig->screen.height_px, settings.screen.height_px);
  ASSERT_TRUE(rig->background.has_value());
  ASSERT_TRUE(rig->triangle.has_value());
  EXPECT_EQ(read_picture(*rig->triangle)->size(), cv::Size(640, 360));
  ASSERT_TRUE(rig->marks.has_value());
  EXPECT_EQ(read_picture(*rig->marks)->size(), cv::Size(640, 360));
  ASSERT_EQ(rig->calibration.size(), 9u);
  EXPECT_EQ(rig->calibration[0].screen.x_mm, 190);

  ASSERT_NE(rig->part("frames"), nullptr);
  EXPECT_EQ(rig->part("frames")->frames.size(), 4u);
  EXPECT_TRUE(rig->part("frames")->truth[0].contact);
  EXPECT_TRUE(rig->part("frames")->truth[2].hover_mm.has_value());
  EXPECT_FALSE(rig->part("frames")->truth[3].screen.has_value());

  const RigPart* sequence = rig->part("sequence");
  ASSERT_NE(sequence, nullptr);
  ASSERT_EQ(sequence->frames.size(), 30u);
  ASSERT_EQ(sequence->times.size(), 30u);
  EXPECT_NEAR(to_ms(sequence->times[29] - sequence->times[0]), 29 / 0.03, 0.01);
  FakeClock clock;
  const VirtualRig virtual_rig(settings, clock);
  for (std::size_t i = 0; i < 30; ++i) {
    const VirtualTruth truth = virtual_rig.truth(i);
    EXPECT_EQ(sequence->truth[i].contact, truth.contact);
    if (truth.screen) {
      EXPECT_NEAR(sequence->truth[i].screen->x_mm, truth.screen->x_mm, 0.006);
    }
  }
}

TEST(ExportedRig, OfARandomRigHasAllItsPartsAndGroups) {
  const TemporaryFolder folder;
  const RandomRig rig = random_rig(3, {320, 180});
  ASSERT_TRUE(export_rig_directory(
      rig, folder.path(), {.calibration_touches = 9, .sequence_frames = 10, .single_frames = 7, .hard_frames = 2}));
  const auto opened = open_rig_directory(folder.path());
  ASSERT_TRUE(opened) << opened.error().message;
  EXPECT_GE(opened->calibration.size(), 5u);
  ASSERT_NE(opened->part("hard"), nullptr);
  EXPECT_EQ(opened->part("hard")->frames.size(), 2u);
  EXPECT_EQ(opened->part("hard")->truth.size(), 4u);  // two fingers, then two hands
  EXPECT_EQ(opened->part("sequence")->frames.size(), 10u);
  const std::vector<TruthRow>& truth = opened->part("frames")->truth;
  ASSERT_EQ(truth.size(), 7u);
  EXPECT_TRUE(truth[0].contact);
  EXPECT_FALSE(truth[0].tone.empty());
  EXPECT_GE(truth[2].hover_mm.value_or(0), 5);
  EXPECT_NE(truth[6].notes.find("away"), std::string::npos);
  std::ifstream toml(folder.path() / "rig.toml");
  const std::string text{std::istreambuf_iterator<char>(toml), {}};
  EXPECT_NE(text.find("coat = \"" + rig.group.coat + "\""), std::string::npos);
}

TEST(ExportedRig, HoldsTheSamePicturesUnderTheSameNamesInAPartOfTheRow) {
  const TemporaryFolder folder;
  const RandomRig rig = random_rig(3, {320, 180});
  ExportSettings settings{.calibration_touches = 0, .sequence_frames = 0, .single_frames = 4, .hard_frames = 2};
  ASSERT_TRUE(export_rig_directory(rig, folder / "all", settings));
  settings.single_frames = settings.skipped_frames = 2;
  settings.hard_frames = settings.skipped_hard_frames = 1;
  ASSERT_TRUE(export_rig_directory(rig, folder / "part", settings));
  const auto all = open_rig_directory(folder / "all");
  const auto part = open_rig_directory(folder / "part");
  ASSERT_TRUE(all.ok() && part.ok());
  const RigFrame& first = part->part("frames")->frames.at(0);
  EXPECT_EQ(first.name, "003");
  EXPECT_EQ(part->part("frames")->truth.at(0).hover_mm, all->part("frames")->truth.at(2).hover_mm);
  const auto picture = read_picture(first.picture);
  const auto same = read_picture(all->part("frames")->frames.at(2).picture);
  EXPECT_EQ(cv::norm(*picture, *same, cv::NORM_INF), 0);
  EXPECT_EQ(part->part("hard")->frames.at(0).name, "002");
}

TEST(ExportedRig, SaysWhereItCantBeWritten) {
  const Status written = export_rig_directory(VirtualRigSettings{}, "/proc/nowhere");
  ASSERT_FALSE(written);
  EXPECT_NE(written.error().message.find("/proc/nowhere"), std::string::npos);
}

}  // namespace
}  // namespace telehug
