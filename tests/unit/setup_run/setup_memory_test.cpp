// SPDX-License-Identifier: Apache-2.0
#include "setup_run/setup_memory.hpp"

#include <gmock/gmock.h>

#include "doubles/temporary_folder.hpp"

namespace telehug {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class WhatWasSetUp : public testing::Test {
 protected:
  TemporaryFolder folder;
  ConfigSources sources{
      .system_folder = folder / "etc", .user_folder = folder / "home", .only_file = {}, .overrides = {}};
  SetupChoice choice{"webcam:/dev/v4l/by-id/usb-Cam \"1\"-video-index0", {597.44, 336, 2560, 1440}, "HDMI-1", {}, true};
};

TEST_F(WhatWasSetUp, IsReadByEveryLaterStart) {
  const auto kept = remember_setup(choice, sources);
  ASSERT_TRUE(kept) << kept.error().message;
  EXPECT_EQ(*kept, folder / "home/active.d/50-setup.toml");
  const auto config = load_active_config(sources);
  ASSERT_TRUE(config) << config.error().message;
  EXPECT_EQ(config->camera.source, "webcam");
  EXPECT_EQ(config->camera.device, "/dev/v4l/by-id/usb-Cam \"1\"-video-index0");
  EXPECT_EQ(config->camera.preset, "auto");
  EXPECT_NEAR(config->rig.screen.width_mm, 597.4, 0.001);
  EXPECT_EQ(config->rig.screen.height_mm, 336);
  EXPECT_EQ(config->rig.screen.width_px, 2560);
  EXPECT_EQ(config->body_map.monitor, "HDMI-1");
}

TEST_F(WhatWasSetUp, LeavesThePresetAndTheMonitorAsTheyAreIfNothingIsKnownOfThem) {
  folder.write("home/active.toml", "[camera]\npreset = \"keep\"\n[body_map]\nmonitor = \"DP-2\"\n");
  choice.tuned = false;
  choice.monitor.clear();
  choice.camera = "virtual:7";
  ASSERT_TRUE(remember_setup(choice, sources));
  const auto config = load_active_config(sources);
  EXPECT_EQ(config->camera.preset, "keep");
  EXPECT_EQ(config->body_map.monitor, "DP-2");
  EXPECT_EQ(config->camera.source, "virtual:7");
}

TEST_F(WhatWasSetUp, TakesThePlaceOfWhatWasSetUpBeforeAndOfNothingElse) {
  folder.write("home/active.toml", "[touch]\nup_after_ms = 90\n");
  ASSERT_TRUE(remember_setup(choice, sources));
  choice.camera = "virtual";
  ASSERT_TRUE(remember_setup(choice, sources));
  const auto config = load_active_config(sources);
  EXPECT_EQ(config->camera.source, "virtual");
  EXPECT_EQ(config->camera.device, "");
  EXPECT_EQ(config->touch.up_after_ms, 90);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder / "home/active.d"), {}), 1)
      << "nothing half written";
}

TEST_F(WhatWasSetUp, IsKeptForTheWholeSystemWhereThereIsNoUsersFolder) {
  sources.user_folder.clear();
  EXPECT_EQ(*remember_setup(choice, sources), folder / "etc/active.d/50-setup.toml");
}

TEST_F(WhatWasSetUp, IsToldToBeWrittenByHandWhereOnlyOneFileIsRead) {
  sources.only_file = folder / "mine.toml";
  const auto kept = remember_setup(choice, sources);
  ASSERT_FALSE(kept);
  EXPECT_THAT(kept.error().message, AllOf(HasSubstr("mine.toml"), HasSubstr("screen_width_mm = 597.4")));
  EXPECT_FALSE(std::filesystem::exists(folder / "home"));
}

TEST_F(WhatWasSetUp, IsToldToBeOverruled) {
  sources.overrides = {"rig.screen_width_mm=400"};
  auto kept = remember_setup(choice, sources);
  ASSERT_FALSE(kept);
  EXPECT_THAT(kept.error().message, HasSubstr("[rig] screen_width_mm is set in --set rig.screen_width_mm=400, too"));
  sources.overrides = {};
  folder.write("home/active.d/60-mine.toml", "[camera]\nsource = \"virtual\"\n");
  kept = remember_setup(choice, sources);
  ASSERT_FALSE(kept);
  EXPECT_THAT(kept.error().message, AllOf(HasSubstr("[camera] source is set in "), HasSubstr("60-mine.toml, too")));
}

TEST_F(WhatWasSetUp, IsToldNotToBeKeptWhereTheFolderCantBeWritten) {
  folder.write("home", "a file is in the way");
  const auto kept = remember_setup(choice, sources);
  ASSERT_FALSE(kept);
  EXPECT_THAT(kept.error().message, HasSubstr("50-setup.toml can't be written; is the folder writable"));
}

}  // namespace
}  // namespace telehug
