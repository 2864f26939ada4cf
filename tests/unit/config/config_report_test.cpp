// SPDX-License-Identifier: Apache-2.0
#include "config/config_report.hpp"

#include <gmock/gmock.h>

#include "config/toml_reader.hpp"
#include "doubles/temporary_folder.hpp"

namespace telehug {
namespace {

class InspectedConfig : public testing::Test {
 protected:
  InspectedConfig() {
    sources.system_folder = folder / "etc";
    sources.user_folder = folder / "home";
  }

  [[nodiscard]] KeySetting key(const std::string& section, const std::string& name) const {
    for (const KeySetting& key : inspect_config(sources, Side::active).settings)
      if (key.section == section && key.name == name) return key;
    throw std::runtime_error("there is no key " + name);
  }

  TemporaryFolder folder;
  ConfigSources sources;
};

TEST_F(InspectedConfig, TellsOfEachKeyValueDefaultAndThatNothingSetIt) {
  const KeySetting fps = key("camera", "fps");
  EXPECT_EQ(fps.value, "30");
  EXPECT_EQ(fps.standard, "30");
  EXPECT_EQ(fps.origin, "");
}

TEST_F(InspectedConfig, TellsWhichFileAndLineCounts) {
  folder.write("etc/active.toml", "[camera]\nwidth_px = 640\nfps = 10\n");
  const auto mine = folder.write("home/active.d/10.toml", "\n[camera]\nfps = 20\n");
  EXPECT_EQ(key("camera", "fps").value, "20");
  EXPECT_EQ(key("camera", "fps").origin, mine.string() + ":3");
  EXPECT_EQ(key("camera", "width_px").origin, (folder / "etc/active.toml").string() + ":2");
}

TEST_F(InspectedConfig, TellsTheFlagThatSetIt) {
  sources.overrides = {"camera.fps=25"};
  EXPECT_EQ(key("camera", "fps").origin, "--set camera.fps=25");
}

TEST_F(InspectedConfig, TellsAllFaultsAndTheValuesThatAreLeft) {
  const auto file = folder.write("etc/active.toml", "[camera]\nfps = 1000\nwidth_px = 640\nlens = 3\n");
  const auto second = folder.write("etc/active.d/a.toml", "[camera]\nfps = 1000\n");
  const ConfigReport report = inspect_config(sources, Side::active);
  ASSERT_EQ(report.faults.size(), 3U);
  EXPECT_EQ(report.faults[0].where, file.string() + ":2");
  EXPECT_EQ(report.faults[1].where, file.string() + ":4");
  EXPECT_EQ(report.faults[2].where, second.string() + ":2");
  EXPECT_EQ(key("camera", "fps").value, "30");
  EXPECT_EQ(key("camera", "width_px").value, "640");
}

TEST_F(InspectedConfig, AgreesWithWhatADaemonWouldLoad) {
  folder.write("etc/passive.toml", "[safety]\ndrive_ms = 100000\n");
  const auto loaded = load_passive_config(sources);
  const ConfigReport report = inspect_config(sources, Side::passive);
  ASSERT_FALSE(loaded);
  ASSERT_EQ(report.faults.size(), 1U);
  EXPECT_EQ(loaded.error().message, report.faults[0].where + ": " + report.faults[0].what);
}

TEST_F(InspectedConfig, TellsTextsWithControlCharactersAsAFileMayHaveThem) {
  const std::string text = "a\"b\\c\nd\x7F";
  std::string target = text;
  const std::string written = toml_text(Target{&target});
  EXPECT_EQ(written, R"("a\"b\\c\u000Ad\u007F")");
}

}  // namespace
}  // namespace telehug
