// SPDX-License-Identifier: Apache-2.0
//
// `telehug config` as a process of its own, with a configuration of the test's.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "doubles/temporary_folder.hpp"
#include "integration/cli/shell.hpp"
#include "service/exit_code.hpp"

namespace telehug {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class ConfigCommand : public testing::Test {
 protected:
  [[nodiscard]] ShellRun run(const std::string& arguments, const std::string& streams = "2>&1") const {
    return shell("XDG_CONFIG_HOME=" + folder.path().string() + " " TELEHUG_BIN "/telehug config " + arguments + " " +
                 streams);
  }
  [[nodiscard]] std::string place(int line) const {
    return (folder / "telehug/active.toml").string() + ":" + std::to_string(line);
  }

  TemporaryFolder folder;
};

TEST_F(ConfigCommand, CheckTellsAllFaultsAtOnceWithFileAndLine) {
  folder.write("telehug/active.toml", "[camera]\nfps = 1000\nwidth_px = \"wide\"\n\n[lamp]\non = true\n");
  const ShellRun check = run("check active");
  EXPECT_EQ(check.code, to_int(ExitCode::config));
  EXPECT_THAT(check.text, AllOf(HasSubstr(place(2) + ": camera.fps is 1000; it must be within 1 .. 240 frames/s"),
                                HasSubstr(place(3) + ": camera.width_px must be a whole number"),
                                HasSubstr(place(5) + ": there is no section [lamp]")));
}

TEST_F(ConfigCommand, CheckIsContentWithARightFileAndNamesIt) {
  folder.write("telehug/active.toml", "[camera]\nfps = 60\n");
  const ShellRun check = run("check");
  EXPECT_EQ(check.code, 0);
  EXPECT_THAT(check.text, AllOf(HasSubstr("active: no fault in " + (folder / "telehug/active.toml").string()),
                                HasSubstr("passive: no fault")));
}

TEST_F(ConfigCommand, DiffTellsOnlyWhatIsNotTheDefault) {
  folder.write("telehug/active.toml", "[camera]\nfps = 60\nwidth_px = 1280\n");
  EXPECT_EQ(run("diff active").text, "active: camera.fps = 60 (default 30), " + place(2) + "\n");
  EXPECT_EQ(run("diff passive").text, "passive: all at their defaults\n");
}

TEST_F(ConfigCommand, WhatShowPrintsIsAFileThatMeansTheSame) {
  folder.write("telehug/active.toml", "[camera]\nfps = 60\n[peer]\npartition = \"a \\\"b\\\" \\\\c\"\n");
  const ShellRun shown = run("show active", "");
  EXPECT_THAT(shown.text, HasSubstr("fps = 60"));
  EXPECT_THAT(shown.text, HasSubstr("# " + place(2)));
  const auto copy = folder.write("copy.toml", shown.text);
  const ShellRun again = run("diff active --config " + copy.string());
  EXPECT_EQ(again.code, 0);
  EXPECT_THAT(again.text, AllOf(HasSubstr("camera.fps = 60"), HasSubstr(R"(peer.partition = "a \"b\" \\c")")));
}

TEST_F(ConfigCommand, ShowTellsFaultsBesideTheValues) {
  folder.write("telehug/active.toml", "[camera]\nfps = 1000\n");
  const ShellRun shown = run("show active");
  EXPECT_EQ(shown.code, to_int(ExitCode::config));
  EXPECT_THAT(shown.text, AllOf(HasSubstr(place(2) + ": camera.fps is 1000"), HasSubstr("fps = 30")));
}

TEST_F(ConfigCommand, TheSystemsServiceDoesNotReadTheUsersFile) {
  folder.write("telehug/active.toml", "[camera]\nfps = 1000\n");
  EXPECT_THAT(run("check active --system").text, Not(HasSubstr(place(2))));
}

TEST_F(ConfigCommand, TellsProgramsTheSameAsJson) {
  folder.write("telehug/active.toml", "[camera]\nfps = 60\nlens = 1\n");
  const ShellRun json = run("show active --json", "");
  EXPECT_EQ(json.code, to_int(ExitCode::config));
  const auto side = nlohmann::json::parse(json.text).at("sides").at(0);
  EXPECT_EQ(side.at("keys").at("camera.fps"), (nlohmann::json{{"value", "60"}, {"default", "30"}, {"from", place(2)}}));
  EXPECT_EQ(side.at("faults").at(0).at("where"), place(3));
}

}  // namespace
}  // namespace telehug
