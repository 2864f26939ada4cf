// SPDX-License-Identifier: Apache-2.0
//
// `telehug report`: what a bug report needs is in it, and nothing that was planted as a secret.
#include <gmock/gmock.h>
#include <sys/stat.h>

#include <cstdlib>
#include <sstream>

#include "doubles/crafted_pair.hpp"
#include "doubles/temporary_folder.hpp"
#include "integration/cli/shell.hpp"
#include "service/control_server.hpp"
#include "service/control_socket.hpp"
#include "service/exit_code.hpp"

namespace telehug {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using Json = nlohmann::json;

class Report : public testing::Test {
 protected:
  Report() {
    fs::create_directories(folder / "run/telehug");
    folder.write("config/telehug/passive.toml",
                 "[jacket]\nlink = \"rfcomm:00:1A:7D:DA:71:13\"\nseveral_senders = \"exclusive\"\n"
                 "[consent]\nquiet_hours = \"20:31-07:02\"\n"
                 "[peer]\nloopback_only = false\naddresses = \"203.0.113.7, 198.51.100.9:7600\"\n"
                 "public_address = \"192.0.2.55\"\npublic_port = 7600\n");
    folder.write(
        "config/telehug/active.toml",
        "[body_map]\nwindow = \"Chat with Philomena\"\nrate_hz = 5\n[camera]\nsource = \"replay:/secret/Videos\"\n");
    folder.write("state/telehug/rig.toml",
                 "date = \"2026-05-04T18:21:07Z\"\nmodel = \"rig\"\n[image]\nwidth_px = 1280\nheight_px = 720\n"
                 "[screen]\nwidth_mm = 520\nheight_mm = 290\n[[touch]]\nerror_x_mm = 3\nerror_y_mm = 4\n");
    CraftedPair(pair).keep(folder / "state/telehug/pairs/passive", Side::passive);
    // A journal, as journalctl prints it.
    folder.write("bin/journalctl", "#!/bin/sh\ncase $* in *telehug-passive*) cat " + (folder / "journal").string() +
                                       ";; *--unit=telehug-active-rig' '*) echo the rig ends;; *--field=TELEHUG_PEER' "
                                       "'*) printf 'Agnes Nitt\\nthe other side\\n';; esac\n");
    fs::permissions(folder / "bin/journalctl", fs::perms::owner_all);
    folder.write("journal",
                 "2026-11-29T12:00:00+0000 telehug-passive[7]: telehug-passive 0.1.0 runs\n"
                 "2026-11-29T12:00:00+0000 telehug-passive[7]: /srv/esmerelda/x can't be read\n"
                 "2026-11-29T12:00:01+0000 telehug-passive[7]: paired with Grandma until 2027-11-28\n"
                 "2026-11-29T12:00:02+0000 telehug-passive[7]: stopped: Philomena has a fever\n"
                 "2026-11-29T12:00:03+0000 telehug-passive[7]: code ABCDE-12345-FGHJK-67890-ABCDE-12345-FGHJK-67890\n"
                 "2026-11-29T12:00:03+0000 telehug-passive[7]: Magrat Garlick is connected\n"
                 "2026-11-29T12:00:03+0000 telehug-passive[7]: nobody knows Agnes Nitt, nor the other side\n"
                 "2026-11-29T12:00:03+0000 telehug-passive[7]: quiet hours until 07:02: nothing is felt\n"
                 "2026-11-29T12:00:04+0000 telehug-passive[7]: no jacket answers on 00:1A:7D:DA:71:13: it is off\n");
  }

  [[nodiscard]] std::string command(const std::string& arguments) const {
    const std::string base = folder.path().string();
    return "cd " + base + " && env -u DISPLAY -u WAYLAND_DISPLAY HOME=" + base +
           " USER=philomena SUDO_USER=esmerelda XDG_CONFIG_HOME=" + base + "/config XDG_STATE_HOME=" + base +
           "/state XDG_RUNTIME_DIR=" + base + "/run PATH=" + base + "/bin:" + std::getenv("PATH") +
           " " TELEHUG_BIN "/telehug report " + arguments + " 2>&1";
  }
  ShellRun run(const std::string& arguments) const { return shell(command(arguments)); }
  [[nodiscard]] std::string content(const std::string& file) const {
    std::ostringstream text;
    text << std::ifstream(folder / file).rdbuf();
    return text.str();
  }
  [[nodiscard]] std::string report() const {
    const ShellRun made = run("--output report.txt");
    EXPECT_EQ(made.code, 0) << made.text;
    return content("report.txt");
  }

  TemporaryFolder folder;
  std::string pair = "0123456789abcdef";
};

// Its side's daemon, as far as a report asks it.
std::unique_ptr<ControlServer> daemon_with_secrets(const fs::path& socket) {
  auto server = std::make_unique<ControlServer>(ControlServerOptions{.socket = socket, .group = {}});
  server->on("status", [](const Json&) -> Json {
    return {{"side", "passive"},
            {"version", "0.1.0"},
            {"session", "feedfacefeedfacefeedfacefeedface"},
            {"state", "fault"},
            {"uptime_s", 12.5},
            {"problems",
             {{{"what", "stopped here: Philomena sleeps"}, {"do", "run `telehug resume`"}},
              {{"what", "no jacket answers"}, {"do", "check its cable"}}}},
            {"pair", {{"id", "0123456789abcdef"}, {"name", "Granny Ogg"}, {"phrase", "apple bread candle"}}},
            {"peer", {{"connected", false}, {"reason", "Ogg is cooking"}, {"round_trip_ms", 0.8}}},
            {"peers", {{{"name", "Nanny Weatherwax"}}}},
            {"consent", {{"name", "quiet hours"}, {"quiet_hours", "20:31-07:02"}, {"muted_boxes", {8, 13}}}},
            {"today", {{"touches", 4711}}},
            {"last_touch", {{"box", 7}}},
            {"web", {{"port", 40123}}},
            {"jacket",
             {{"name", "Philomena's"},
              {"device", "/dev/serial/by-id/usb-Arduino_95530343-if00"},
              {"state", "absent"},
              {"firmware", 2},
              {"motors", 16}}},
            {"counters", {{"touches", 12}, {"jacket_reconnects", 3}}}};
  });
  server->start();
  return server;
}

TEST_F(Report, HoldsWhatABugReportNeeds) {
  const auto daemon = daemon_with_secrets(folder / "run/telehug/passive.sock");
  const std::string text = report();
  EXPECT_THAT(text, AllOf(HasSubstr("\ntelehug "), HasSubstr("\nkernel "), HasSubstr("== doctor =="),
                          HasSubstr("jacket.link = \"rfcomm:[...]\""), HasSubstr("several_senders = \"exclusive\""),
                          HasSubstr("body_map.rate_hz = 5")));
  EXPECT_THAT(text, AllOf(HasSubstr("peer.addresses = [a text of"), HasSubstr("\"jacket_reconnects\": 3"),
                          HasSubstr("no jacket answers"), HasSubstr("firmware: 2"), HasSubstr("image.width_px: 1280"),
                          HasSubstr("touches: 1, errors: 5.00 mm")));
  EXPECT_THAT(text, AllOf(HasSubstr("telehug-passive 0.1.0 runs"), HasSubstr("telehug-active does not run"),
                          HasSubstr("nothing is in the journal"), HasSubstr("nor the other side")));
}

TEST_F(Report, HoldsNothingThatIsNobodyElsesBusiness) {
  const auto daemon = daemon_with_secrets(folder / "run/telehug/passive.sock");
  const std::string text = report();
  for (const char* secret : {"Philomena",         "philomena",   "203.0.113",     "198.51.100", "192.0.2",
                             "00:1A:7D",          "20:31",       "secret/Videos", "Grandma",    "Ogg",
                             "apple bread",       "Weatherwax",  "Agnes",         "Garlick",    "07:02",
                             "esmerelda",         "4711",        "40123",         "feedface",   "0123456789abcdef",
                             "crafted by a test", "FGHJK",       "fever",         "cooking",    "sleeps",
                             "95530343",          "PRIVATE KEY", "BEGIN",         "muted",      "last_touch"})
    EXPECT_THAT(text, Not(HasSubstr(secret)));
  EXPECT_THAT(text, Not(HasSubstr(folder.path().string())));
}

TEST_F(Report, HoldsTheLogOfAFixedRig) {
  const std::string text = report();
  EXPECT_THAT(text, AllOf(HasSubstr("--user-unit telehug-active: nothing"),
                          HasSubstr("-u telehug-active-rig: \nthe rig ends")));
}

TEST_F(Report, SaysWhereItIsAndWhatIsInIt) {
  const ShellRun made = run("--output report.txt");
  EXPECT_THAT(made.text, AllOf(HasSubstr((folder / "report.txt").string()), HasSubstr("Not in it: pictures"),
                               HasSubstr("Read it before you send it")));
  struct stat about {};
  ASSERT_EQ(::stat((folder / "report.txt").c_str(), &about), 0);
  EXPECT_EQ(about.st_mode & 0777, 0600U);
}

TEST_F(Report, HasANameOfItsOwnIfNoneIsGiven) {
  EXPECT_THAT(run("passive").text, HasSubstr((folder / "telehug-report-").string()));
}

TEST_F(Report, OverwritesNothing) {
  folder.write("report.txt", "mine");
  const ShellRun made = run("--output report.txt");
  EXPECT_EQ(made.code, to_int(ExitCode::internal));
  EXPECT_THAT(made.text, HasSubstr("report.txt can't be written"));
  EXPECT_EQ(content("report.txt"), "mine");
}

TEST_F(Report, LeavesNothingBehindWhereNothingFits) {
  const ShellRun failed = shell("ulimit -f 0; trap '' XFSZ; " + command("--output report.txt"));
  EXPECT_NE(failed.code, 0);
  EXPECT_THAT(failed.text, AllOf(HasSubstr("report.txt can't be written"), HasSubstr("free some space")));
  EXPECT_FALSE(fs::exists(folder / "report.txt"));
}

TEST_F(Report, TellsThatThereIsNoJournal) {
  folder.write("bin/journalctl", "#!/bin/sh\nexit 1\n");
  EXPECT_THAT(report(), HasSubstr("-u telehug-passive: no journal can be read"));
}

}  // namespace
}  // namespace telehug
