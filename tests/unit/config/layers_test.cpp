// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "config/load.hpp"
#include "doubles/temporary_folder.hpp"

namespace telehug {
namespace {

class ConfigLayers : public testing::Test {
 protected:
  ConfigLayers() {
    sources_.system_folder = folder_.path() / "etc";
    sources_.user_folder = folder_.path() / "home";
  }
  ActiveConfig load() {
    auto config = load_active_config(sources_);
    EXPECT_TRUE(config) << (config ? "" : config.error().message);
    return config ? *config : ActiveConfig{};
  }
  TemporaryFolder folder_;
  ConfigSources sources_;
};

TEST_F(ConfigLayers, MayAllBeMissing) {
  EXPECT_EQ(load().camera.fps, 30);
}

TEST_F(ConfigLayers, WinOverEarlierOnesKeyByKey) {
  folder_.write("etc/active.toml", "[camera]\nfps = 1\nwidth_px = 640\nheight_px = 400\n[peer]\ndomain = 1\n");
  folder_.write("etc/active.d/20-b.toml", "[camera]\nfps = 3\n");
  folder_.write("etc/active.d/10-a.toml", "[camera]\nfps = 2\nwidth_px = 800\n");
  folder_.write("home/active.toml", "[camera]\nheight_px = 480\n");
  folder_.write("home/active.d/x.toml", "[peer]\ndomain = 4\n");
  sources_.overrides = {"peer.partition=anna=1", "touch.up_after_ms=90"};
  const ActiveConfig config = load();
  EXPECT_EQ(config.camera.fps, 3);
  EXPECT_EQ(config.camera.width_px, 800);
  EXPECT_EQ(config.camera.height_px, 480);
  EXPECT_EQ(config.peer.domain, 4);
  EXPECT_EQ(config.peer.partition, "anna=1");
  EXPECT_EQ(config.touch.up_after_ms, 90);
}

TEST_F(ConfigLayers, OfADropInFolderAreOnlyTomlFilesThatAreNotHidden) {
  folder_.write("etc/active.d/a.toml.bak", "nonsense");
  folder_.write("etc/active.d/.a.toml", "nonsense");
  EXPECT_EQ(load().camera.fps, 30);
}

TEST_F(ConfigLayers, AreReplacedByAFileOfTheCommandLine) {
  folder_.write("etc/active.toml", "[camera]\nfps = 1\n");
  sources_.only_file = folder_.write("mine.toml", "[camera]\nwidth_px = 640\n");
  sources_.overrides = {"camera.height_px=480"};
  const ActiveConfig config = load();
  EXPECT_EQ(config.camera.fps, 30);
  EXPECT_EQ(config.camera.width_px, 640);
  EXPECT_EQ(config.camera.height_px, 480);
}

TEST_F(ConfigLayers, OfTheOtherSideAreNotRead) {
  folder_.write("etc/passive.toml", "nonsense");
  EXPECT_TRUE(load_active_config(sources_));
  EXPECT_FALSE(load_passive_config(sources_));
}

TEST_F(ConfigLayers, TakeWholeNumbersForNumbers) {
  folder_.write("etc/active.toml", "[body_map]\nrate_hz = 5\n[rig]\nscreen_width_mm = 520\nscreen_height_mm = 300.5\n");
  const ActiveConfig config = load();
  EXPECT_EQ(config.body_map.rate_hz, 5.0);
  EXPECT_EQ(config.rig.screen.width_mm, 520.0);
  EXPECT_EQ(config.rig.screen.height_mm, 300.5);
}

}  // namespace
}  // namespace telehug
