// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "integration/ctl/telehug_command.hpp"
#include "service/exit_code.hpp"

namespace telehug {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using Json = nlohmann::json;
using OpenCommand = TelehugCommand;

TEST_F(OpenCommand, OpensThePagesOfTheDaemonThatItIsToldOrOfAll) {
  const auto active = daemon(Side::active, Json::object());
  const auto passive = daemon(Side::passive, Json::object());
  EXPECT_EQ(run("open passive --print").out, "http://127.0.0.1:4000/enter?link=passive\n");
  EXPECT_EQ(run("open --print").out,
            "http://127.0.0.1:4000/enter?link=active\nhttp://127.0.0.1:4000/enter?link=passive\n");
  EXPECT_EQ(run("open nobody").code, to_int(ExitCode::usage));
}

TEST_F(OpenCommand, GivesALinkToTheBrowserOrToThePersonIfThereIsNone) {
  const auto passive = daemon(Side::passive, Json::object());
  const std::string browser = folder_.write("xdg-open", "#!/bin/sh\necho \"$1\" > \"$0.opened\"\n");
  std::filesystem::permissions(browser, std::filesystem::perms::owner_all);
  const std::string path = "env PATH=" + folder_.path().string() + ":/usr/bin:/bin";
  EXPECT_EQ(run("open passive", path).code, 0);
  EXPECT_EQ(content(browser + ".opened"), "http://127.0.0.1:4000/enter?link=passive\n");
  const Outcome failed = run("open passive", "env PATH=/nowhere:/usr/bin");
  EXPECT_EQ(failed.code, to_int(ExitCode::internal));
  EXPECT_THAT(failed.errors, HasSubstr("open this link within a minute: http://127.0.0.1:4000/enter?link=passive"));
}

TEST_F(OpenCommand, StartsTheParentsSideToOpenItsPageIfToldSoAndNothingRuns) {
  const std::string systemctl = folder_.write(
      "systemctl",
      "#!/bin/sh\necho \"$*\" >> \"$0.called\"\ncd \"$XDG_RUNTIME_DIR/telehug\" && mv ready active.sock\n");
  std::filesystem::permissions(systemctl, std::filesystem::perms::owner_all);
  const std::string path = "env PATH=" + folder_.path().string() + ":/usr/bin:/bin";
  ControlServer server({.socket = runtime_ / "telehug/ready", .group = {}});
  server.on("open", [](const Json&) { return Json{{"url", "http://127.0.0.1:4000/enter?link=started"}}; });
  server.start();

  EXPECT_EQ(run("open --print", path).code, to_int(ExitCode::not_running));
  EXPECT_FALSE(std::filesystem::exists(systemctl + ".called"));

  EXPECT_EQ(run("open --start --print", path).out, "http://127.0.0.1:4000/enter?link=started\n");
  EXPECT_EQ(content(systemctl + ".called"), "--user start telehug-active.service\n");
  EXPECT_EQ(run("open --start --print", path).out, "http://127.0.0.1:4000/enter?link=started\n");
  EXPECT_EQ(content(systemctl + ".called"), "--user start telehug-active.service\n") << "it ran already";
}

TEST_F(OpenCommand, TellsWhyTheParentsSideCantBeStarted) {
  const std::string systemctl =
      folder_.write("systemctl", "#!/bin/sh\necho Unit telehug-active.service not found. >&2\nexit 5\n");
  std::filesystem::permissions(systemctl, std::filesystem::perms::owner_all);
  const Outcome outcome = run("open --start", "env PATH=" + folder_.path().string() + ":/usr/bin:/bin");
  EXPECT_EQ(outcome.code, to_int(ExitCode::not_running));
  EXPECT_THAT(outcome.errors, HasSubstr("telehug-active can't be started: Unit telehug-active.service not found."));
}

TEST_F(OpenCommand, OpensNothingButAPageOfThisPc) {
  for (const Json& url : {Json("file:///etc/passwd"), Json("--version"), Json("http://evil.example/"),
                          Json("http://127.0.0.1:1/ --x"), Json(5), Json()}) {
    auto server =
        std::make_unique<ControlServer>(ControlServerOptions{.socket = runtime_ / "telehug/passive.sock", .group = {}});
    server->on("open", [url](const Json&) { return Json{{"url", url}}; });
    server->start();
    EXPECT_EQ(run("open passive --print").code, to_int(ExitCode::bad_answer)) << url;
    EXPECT_THAT(run("open passive --print").out, IsEmpty()) << url;
  }
}

}  // namespace
}  // namespace telehug
