// SPDX-License-Identifier: Apache-2.0
//
// The `telehug` program as a process of its own, against a control server in this one.
#include <gmock/gmock.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <atomic>
#include <cstring>
#include <sstream>
#include <thread>

#include "integration/ctl/telehug_command.hpp"
#include "service/exit_code.hpp"

namespace telehug {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using Json = nlohmann::json;

TEST_F(TelehugCommand, PrintsItsVersion) {
  const Outcome outcome = run("version");
  EXPECT_EQ(outcome.code, to_int(ExitCode::ok));
  EXPECT_THAT(outcome.out, testing::MatchesRegex("telehug [0-9]+[.][0-9]+[.][0-9]+\n"));
}

TEST_F(TelehugCommand, HelpsWithExamples) {
  const Outcome outcome = run("--help");
  EXPECT_EQ(outcome.code, to_int(ExitCode::ok));
  EXPECT_THAT(outcome.out, HasSubstr("Examples:\n"));
}

TEST_F(TelehugCommand, RefusesACommandLineItDoesNotUnderstand) {
  for (const char* wrong : {"",
                            "dance",
                            "status --loud",
                            "status --side left",
                            "watch --count 0",
                            "hug --seconds 11",
                            "hug --seconds 0.1",
                            "hug --strength 0",
                            "hug --strength 1.5",
                            "pause 0",
                            "pause 1441",
                            "pause soon",
                            "mute",
                            "mute 0",
                            "mute 101",
                            "mute --actuator 256",
                            "quiet",
                            "quiet 20:30",
                            "quiet 10:00-10:00",
                            "quiet \"\"",
                            "mute --all",
                            "unmute",
                            "unpause 5"}) {
    const Outcome outcome = run(wrong);
    EXPECT_EQ(outcome.code, to_int(ExitCode::usage)) << wrong;
    EXPECT_FALSE(outcome.errors.empty()) << wrong;
  }
}

TEST_F(TelehugCommand, SaysSoWhenNoDaemonRuns) {
  const std::string nowhere = "--socket " + (folder_.path() / "no.sock").string();
  for (const char* command : {"status ", "watch ", "stop ", "resume ", "hug "}) {
    const Outcome outcome = run(command + nowhere);
    EXPECT_EQ(outcome.code, to_int(ExitCode::not_running)) << command;
    EXPECT_THAT(outcome.errors, HasSubstr("no telehug daemon answers on")) << command;
  }
}

TEST_F(TelehugCommand, SaysSoWhenOnlyALeftSocketIsThere) {
  const std::string socket = (runtime_ / "telehug/active.sock").string();
  // A bound socket that nobody listens on is what a killed daemon leaves.
  const int fd = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::strncpy(address.sun_path, socket.c_str(), sizeof(address.sun_path) - 1);
  ASSERT_EQ(bind(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  close(fd);
  EXPECT_EQ(run("status --side active --socket " + socket).code, to_int(ExitCode::not_running));
}

TEST_F(TelehugCommand, ShowsEveryDaemonsStatus) {
  const auto active = daemon(Side::active, {{"side", "active"}, {"state", "ok"}, {"peer", {{"connected", true}}}});
  const auto passive = daemon(Side::passive, {{"side", "passive"}, {"state", "fault"}, {"gloves", {{"left", 1}}}});
  const Outcome both = run("status");
  EXPECT_EQ(both.code, to_int(ExitCode::ok)) << both.errors;
  EXPECT_THAT(both.out, HasSubstr("active side: ok\n"));
  EXPECT_THAT(both.out, HasSubstr("passive side: fault\n"));
  EXPECT_THAT(both.out, HasSubstr("left 1"));
  EXPECT_THAT(run("status --side active").out, testing::Not(HasSubstr("passive side")));
}

TEST_F(TelehugCommand, PrintsJsonForPrograms) {
  const Json status{{"side", "active"}, {"state", "ok"}, {"counters", {{"touches", 3}}}};
  const auto active = daemon(Side::active, status);
  const Outcome outcome = run("status --json --side active");
  EXPECT_EQ(outcome.code, to_int(ExitCode::ok));
  EXPECT_EQ(Json::parse(outcome.out), Json({{"daemons", {status}}}));

  const Outcome none = run("status --json --socket /nowhere/x.sock");
  EXPECT_EQ(none.code, to_int(ExitCode::not_running));
  EXPECT_EQ(Json::parse(none.out), Json({{"daemons", Json::array()}}));
}

TEST_F(TelehugCommand, MakesAnExitCodeOfAStatusWhenAsked) {
  const struct {
    Json status;
    ExitCode expected;
  } cases[] = {
      {{{"state", "ok"}, {"peer", {{"connected", true}}}}, ExitCode::ok},
      {{{"state", "waiting"}, {"peer", {{"connected", false}}}}, ExitCode::peer_absent},
      {{{"state", "stopped"}, {"peer", {{"connected", false}}}}, ExitCode::stopped},
      {{{"state", "paused"}, {"peer", {{"connected", true}}}}, ExitCode::stopped},
      {{{"state", "fault"}}, ExitCode::fault},
  };
  for (const auto& [status, expected] : cases) {
    const auto active = daemon(Side::active, status);
    EXPECT_EQ(run("status --check --side active").code, to_int(expected)) << status;
    EXPECT_EQ(run("status --side active").code, to_int(ExitCode::ok)) << status;
  }
}

TEST_F(TelehugCommand, EndsWithTheGravestOfBothSidesWhenAsked) {
  const Json absent{{"state", "waiting"}, {"peer", {{"connected", false}}}};
  const Json stopped{{"state", "stopped"}};
  const Json fault{{"state", "fault"}};
  const struct {
    Json active;
    Json passive;
    ExitCode expected;
  } cases[] = {{absent, fault, ExitCode::fault},
               {fault, absent, ExitCode::fault},
               {absent, stopped, ExitCode::stopped},
               {stopped, fault, ExitCode::fault},
               {{{"state", "ok"}}, absent, ExitCode::peer_absent}};
  for (const auto& [of_active, of_passive, expected] : cases) {
    const auto active = daemon(Side::active, of_active);
    const auto passive = daemon(Side::passive, of_passive);
    EXPECT_EQ(run("status --check").code, to_int(expected)) << of_active << of_passive;
  }
}

TEST_F(TelehugCommand, PassesTheReasonOfAStopOn) {
  const auto active = daemon(Side::active, Json::object());
  const Outcome outcome = run("stop --side active --reason 'bed time'");
  EXPECT_EQ(outcome.code, to_int(ExitCode::ok));
  EXPECT_EQ(outcome.out, "active: stopped\n");
  EXPECT_EQ(reason_, "bed time");
}

TEST_F(TelehugCommand, HugsTheOtherSideOfTheDaemonThatRunsHere) {
  {
    const auto passive = daemon(Side::passive, Json::object());
    const Outcome outcome = run("hug");
    EXPECT_EQ(outcome.code, to_int(ExitCode::ok)) << outcome.errors;
    EXPECT_EQ(outcome.out, "passive: hug\n");
    EXPECT_EQ(hug_, Json({{"command", "hug"}}));
  }
  const auto active = daemon(Side::active, Json::object());
  EXPECT_EQ(run("hug --seconds 4 --strength 0.5").out, "active: hug\n");
  EXPECT_EQ(hug_, Json({{"command", "hug"}, {"seconds", 4.0}, {"strength", 0.5}}));
}

TEST_F(TelehugCommand, AsksWhichWayAHugGoesWhereBothSidesRun) {
  const auto active = daemon(Side::active, Json::object());
  const auto passive = daemon(Side::passive, Json::object());
  const Outcome outcome = run("hug");
  EXPECT_EQ(outcome.code, to_int(ExitCode::usage));
  EXPECT_THAT(outcome.errors, HasSubstr("--side active hugs the wearer, --side passive hugs back"));
  EXPECT_TRUE(hug_.is_null());
  EXPECT_EQ(run("hug --side passive").out, "passive: hug\n");
}

TEST_F(TelehugCommand, TellsTheWearersDaemonAloneWhatTheyWant) {
  const auto active = daemon(Side::active, Json::object());
  const Outcome nobody = run("pause");
  EXPECT_EQ(nobody.code, to_int(ExitCode::not_running));
  EXPECT_THAT(nobody.errors, HasSubstr("no telehug-passive is running"));
  const auto passive = daemon(Side::passive, Json::object());
  EXPECT_EQ(run("pause").out, "passive: paused until `telehug unpause`\n");
  EXPECT_EQ(order_, Json({{"command", "pause"}}));
  EXPECT_EQ(run("pause 30").out, "passive: paused for 30 min\n");
  EXPECT_EQ(order_, Json({{"command", "pause"}, {"minutes", 30}}));
  EXPECT_EQ(run("unpause").out, "passive: unpaused\n");
  EXPECT_EQ(order_, Json({{"command", "unpause"}}));
  EXPECT_EQ(run("mute 8 13 --actuator 3").out, "passive: muted\n");
  EXPECT_EQ(order_, Json({{"command", "mute"}, {"boxes", {8, 13}}, {"actuators", {3}}}));
  EXPECT_EQ(run("unmute 8").out, "passive: unmuted\n");
  EXPECT_EQ(order_, Json({{"command", "unmute"}, {"boxes", {8}}, {"actuators", Json::array()}}));
  EXPECT_EQ(run("strength 45").out, "passive: 45 % of what the limits allow\n");
  EXPECT_EQ(order_, Json({{"command", "strength"}, {"strength", 0.45}}));
  EXPECT_EQ(run("strength 101").code, to_int(ExitCode::usage));
  EXPECT_EQ(run("quiet 20:30-07:00,13:00-14:00").out, "passive: quiet hours: 20:30-07:00,13:00-14:00\n");
  EXPECT_EQ(order_, Json({{"command", "quiet"}, {"hours", "20:30-07:00,13:00-14:00"}}));
  EXPECT_EQ(run("quiet none").out, "passive: no quiet hours of the wearer's own\n");
  EXPECT_EQ(order_, Json({{"command", "quiet"}, {"hours", ""}}));
  EXPECT_EQ(run("unmute --all").code, to_int(ExitCode::ok));
  EXPECT_EQ(order_.value("all", false), true);
}

TEST_F(TelehugCommand, TellsWhyADaemonRefuses) {
  const auto active = daemon(Side::active, Json::object());
  const Outcome outcome = run("resume --side active");
  EXPECT_EQ(outcome.code, to_int(ExitCode::refused));
  EXPECT_THAT(outcome.errors, HasSubstr("the other side has stopped"));
}

TEST_F(TelehugCommand, WatchesEvents) {
  const auto active = daemon(Side::active, Json::object());
  std::atomic<bool> done{false};
  std::thread sender([&] {
    for (int n = 0; !done; ++n) {
      active->broadcast({{"event", "touch"}, {"side", "active"}, {"box", 7}});
      std::this_thread::sleep_for(1ms);
    }
  });
  const Outcome json = run("watch --json --count 3 --side active");
  const Outcome human = run("watch --count 1 --side active");
  done = true;
  sender.join();
  EXPECT_EQ(json.code, to_int(ExitCode::ok));
  std::istringstream lines(json.out);
  int count = 0;
  for (std::string line; std::getline(lines, line); ++count)
    EXPECT_EQ(Json::parse(line)["box"], 7);
  EXPECT_EQ(count, 3);
  EXPECT_EQ(human.out, "active   touch      box=7\n");
}

TEST_F(TelehugCommand, StopsWatchingWhenTheDaemonGoes) {
  auto active = daemon(Side::active, Json::object());
  std::thread stopper([&] {
    while (!active->has_watchers())
      std::this_thread::yield();
    active.reset();
  });
  const Outcome outcome = run("watch --side active");
  stopper.join();
  EXPECT_EQ(outcome.code, to_int(ExitCode::not_running));
  EXPECT_THAT(outcome.errors, HasSubstr("has closed the connection"));
}

TEST_F(TelehugCommand, SaysSoWhenTheSocketIsNotForThisUser) {
  if (geteuid() != 0) GTEST_SKIP() << "only root can become another user";
  const auto active = daemon(Side::active, Json::object());
  std::filesystem::permissions(folder_.path(), std::filesystem::perms(0755));
  const std::string socket = (runtime_ / "telehug/active.sock").string();
  const Outcome outcome = run("stop --socket " + socket, "setpriv --reuid 65534 --regid 65534 --clear-groups");
  if (outcome.code == 126) GTEST_SKIP() << "another user may not run the built program: " << outcome.errors;
  EXPECT_EQ(outcome.code, to_int(ExitCode::permission));
  EXPECT_THAT(outcome.errors, HasSubstr("may not be used by this user"));
}

TEST_F(TelehugCommand, WorksWithoutANetwork) {
  const auto active = daemon(Side::active, {{"side", "active"}, {"state", "ok"}});
  // In a network namespace of its own not even the loopback device is up.
  if (std::system("unshare --net true 2>/dev/null") != 0) GTEST_SKIP() << "no network namespace can be made here";
  const Outcome outcome = run("status --side active", "unshare --net");
  EXPECT_EQ(outcome.code, to_int(ExitCode::ok));
  EXPECT_THAT(outcome.out, HasSubstr("active side: ok"));
}

TEST_F(TelehugCommand, SurvivesAnAnswerThatIsNoTelehugDaemons) {
  auto server =
      std::make_unique<ControlServer>(ControlServerOptions{.socket = runtime_ / "telehug/active.sock", .group = {}});
  server->on("status", [](const Json&) { return Json(5); });
  server->start();
  const Outcome outcome = run("status --side active");
  EXPECT_EQ(outcome.code, to_int(ExitCode::bad_answer));
  EXPECT_THAT(outcome.errors, HasSubstr("not a telehug daemon"));
}

}  // namespace
}  // namespace telehug
