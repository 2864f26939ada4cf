// SPDX-License-Identifier: Apache-2.0
#include "config/places.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

namespace telehug {
namespace {

TEST(RigFile, IsAsConfiguredElseInTheStateFolder) {
  setenv("STATE_DIRECTORY", "/var/lib/telehug:/var/lib/other", 1);
  setenv("XDG_STATE_HOME", "/home/x/state", 1);
  EXPECT_EQ(rig_file({}), "/var/lib/telehug/rig.toml");
  unsetenv("STATE_DIRECTORY");
  EXPECT_EQ(rig_file({}), "/home/x/state/telehug/rig.toml");
  EXPECT_EQ(rig_file({.calibration_file = "mine.toml", .screen = {}}), "mine.toml");
  unsetenv("XDG_STATE_HOME");
  EXPECT_TRUE(rig_file({}).is_absolute());
}

TEST(ScreenConsentFile, LiesInTheStateFolder) {
  setenv("STATE_DIRECTORY", "/var/lib/telehug", 1);
  EXPECT_EQ(screen_consent_file(), "/var/lib/telehug/screen-consent");
  unsetenv("STATE_DIRECTORY");
  EXPECT_TRUE(screen_consent_file().is_absolute());
}

TEST(ConsentFile, IsAsConfiguredElseInTheStateFolder) {
  setenv("STATE_DIRECTORY", "/var/lib/telehug", 1);
  EXPECT_EQ(consent_file({}), "/var/lib/telehug/consent.json");
  EXPECT_EQ(consent_file({.quiet_hours = {}, .file = "/a/mine.json"}), "/a/mine.json");
  unsetenv("STATE_DIRECTORY");
  EXPECT_TRUE(consent_file({}).is_absolute());
}

TEST(StopFile, IsAsConfiguredElseTheSidesOwnInTheStateFolder) {
  setenv("STATE_DIRECTORY", "/var/lib/telehug", 1);
  EXPECT_EQ(stop_file({}, Side::active), "/var/lib/telehug/stop-active.json");
  EXPECT_EQ(stop_file({}, Side::passive), "/var/lib/telehug/stop-passive.json");
  ControlConfig config;
  config.stop_file = "/a/mine.json";
  EXPECT_EQ(stop_file(config, Side::passive), "/a/mine.json");
  unsetenv("STATE_DIRECTORY");
  EXPECT_TRUE(stop_file({}, Side::active).is_absolute());
}

TEST(JacketProfileFile, IsAsConfiguredElseTheInstalledOne) {
  JacketConfig config;
  EXPECT_TRUE(jacket_profile_file(config).is_absolute());
  EXPECT_EQ(jacket_profile_file(config).filename(), "duemilanove-16.toml");
  EXPECT_TRUE(std::filesystem::exists(jacket_profile_file(config))) << "the build tree has it, too";
  config.profile = "/a/b.toml";
  EXPECT_EQ(jacket_profile_file(config), "/a/b.toml");
  config.profile = "no-such-profile.toml";
  EXPECT_EQ(jacket_profile_file(config), "no-such-profile.toml");
}

}  // namespace
}  // namespace telehug
