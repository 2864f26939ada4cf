// SPDX-License-Identifier: Apache-2.0
#include "ctl/doctor/checks.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace telehug {
namespace {

using testing::HasSubstr;
using Json = nlohmann::json;

DoctorFacts facts_of(Side side) {
  DoctorFacts facts;
  SideFacts about;
  about.side = side;
  about.state.path = "/var/lib/telehug";
  about.state.usable = true;
  about.state.free_bytes = std::uint64_t{1} << 30;
  facts.sides.push_back(about);
  return facts;
}

TEST(DoctorChecks, AFullDiskFails) {
  DoctorFacts facts = facts_of(Side::passive);
  EXPECT_EQ(check_disk(facts).front().level, Level::ok);
  facts.sides[0].state.free_bytes = 1 << 20;
  EXPECT_EQ(check_disk(facts).front().level, Level::fail);
}

TEST(DoctorChecks, AClockThatIsNotSynchronisedIsToldAndAnUnknownOneIsNot) {
  DoctorFacts facts;
  EXPECT_TRUE(check_clock(facts).empty());
  facts.clock_synchronised = false;
  EXPECT_THAT(check_clock(facts).front().fix, HasSubstr("set-ntp true"));
  facts.clock_synchronised = true;
  EXPECT_EQ(check_clock(facts).front().level, Level::ok);
}

TEST(DoctorChecks, AFirewallIsJudgedByThePortsOfTheDomainAndOnlyIfItMayBeRead) {
  DoctorFacts facts = facts_of(Side::passive);
  facts.firewall = Json::parse(R"({"nftables": [
      {"chain": {"family": "inet", "table": "f", "name": "in", "type": "filter", "hook": "input", "prio": 0,
                 "policy": "drop"}},
      {"rule": {"family": "inet", "table": "f", "chain": "in", "expr": [
          {"match": {"op": "==", "left": {"payload": {"protocol": "udp", "field": "dport"}},
                     "right": {"range": [26650, 26679]}}},
          {"accept": null}]}}]})");
  EXPECT_EQ(check_firewall(facts).front().level, Level::ok);
  facts.sides[0].domain = 78;
  EXPECT_EQ(check_firewall(facts).front().level, Level::fail);
  EXPECT_THAT(check_firewall(facts).front().fix, HasSubstr("26900 to 26929"));
  EXPECT_THAT(check_firewall(facts).front().fix,
              HasSubstr("sudo nft insert rule inet f in ip saddr PEER udp dport 26900-26929 accept"));
  facts.sides[0].loopback_only = true;
  EXPECT_TRUE(check_firewall(facts).empty());
  facts.sides[0].loopback_only = false;
  facts.firewall_is_secret = true;
  EXPECT_THAT(check_firewall(facts).front().fix, HasSubstr("sudo"));
}

// On an installed PC: deploy/packages/packages.cmake puts docs/ there.
TEST(DoctorChecks, NameNoPageButInstalledOnes) {
  const std::string installed = "/usr/share/doc/telehug-common/";
  int pages = 0;
  for (const auto& file : std::filesystem::directory_iterator(TELEHUG_SOURCE "/common/ctl/doctor")) {
    std::ifstream stream(file.path());
    const std::string text((std::istreambuf_iterator<char>(stream)), {});
    EXPECT_EQ(text.find("deploy/"), std::string::npos) << file.path();
    for (std::size_t at = text.find("docs/"); at != std::string::npos; at = text.find("docs/", at + 1), ++pages) {
      const std::string page = text.substr(at, text.find_first_of("\" ,;)", at) - at);
      EXPECT_EQ(text.substr(at - std::min(at, installed.size()), installed.size()), installed) << page;
      EXPECT_TRUE(std::filesystem::exists(std::filesystem::path(TELEHUG_SOURCE) / page)) << page;
    }
  }
  EXPECT_GT(pages, 0);
}

TEST(DoctorChecks, RulesOfTheOldIptablesAreNotTakenForJudged) {
  DoctorFacts facts = facts_of(Side::passive);
  facts.legacy_firewall = true;
  EXPECT_EQ(check_firewall(facts).front().level, Level::warn);
}

TEST(DoctorChecks, TheAccountOfAServiceIsNotToldToLogIn) {
  DoctorFacts facts = facts_of(Side::passive);
  facts.serial_port = "/dev/a";
  facts.serial_ports = {{"/dev/a", false}};
  facts.sides[0].account = {"telehug", false, true};
  EXPECT_EQ(check_serial(facts).front().fix,
            "sudo usermod -aG dialout telehug, then sudo systemctl restart telehug-passive");
  facts.sides[0].account = {"mia", true, false};
  EXPECT_EQ(check_serial(facts).front().fix, "sudo usermod -aG dialout mia, then log in again");
  // Whoever asks: the daemon has it.
  facts.daemons.push_back(Json{{"side", "passive"}});
  EXPECT_EQ(check_serial(facts).front().level, Level::ok);
}

TEST(DoctorChecks, AUnitIsToldWithTheCommandThatMendsIt) {
  DoctorFacts facts = facts_of(Side::active);
  auto& unit = facts.sides[0].units.emplace_back();
  EXPECT_TRUE(check_units(facts).empty());  // there is none
  unit = {"telehug-active.service", true, "loaded", "inactive", "disabled", "success", 0};
  EXPECT_EQ(check_units(facts).front().fix, "systemctl --user enable --now telehug-active.service");
  unit.enabled = "enabled";
  EXPECT_EQ(check_units(facts).front().fix, "systemctl --user start telehug-active.service");
  unit.active = "activating";
  unit.restarts = 3;
  unit.result = "watchdog";
  EXPECT_EQ(check_units(facts).front().level, Level::fail);
  EXPECT_THAT(check_units(facts).front().what, HasSubstr("watchdog"));
  unit.active = "active";
  EXPECT_EQ(check_units(facts).front().level, Level::ok);
  unit.enabled = "disabled";
  EXPECT_EQ(check_units(facts).front().fix, "systemctl --user enable telehug-active.service");
}

TEST(DoctorChecks, OfTheActiveSidesTwoUnitsTheIdleOneIsNotMissed) {
  DoctorFacts facts = facts_of(Side::active);
  facts.sides[0].units = {{"telehug-active.service", true, "loaded", "active", "enabled", "success", 0},
                          {"telehug-active.service", false, "loaded", "inactive", "disabled", "success", 0}};
  EXPECT_EQ(check_units(facts).size(), 1U);
}

// The system's unit of the active side is a fixed rig's: another name than the user's.
TEST(DoctorChecks, AFailedRigIsToldAndTheUsersIdleUnitIsNotMissedBesideIt) {
  DoctorFacts facts = facts_of(Side::active);
  facts.sides[0].units = {{"telehug-active.service", true, "loaded", "inactive", "disabled", "success", 0},
                          {"telehug-active-rig.service", false, "loaded", "failed", "enabled", "exit-code", 5}};
  ASSERT_EQ(check_units(facts).size(), 1U);
  EXPECT_EQ(check_units(facts)[0].level, Level::fail);
  EXPECT_THAT(check_units(facts)[0].fix, HasSubstr("sudo systemctl restart telehug-active-rig.service"));
}

TEST(DoctorChecks, AFixedRigIsJudgedAsItsServiceHasIt) {
  DoctorFacts facts = facts_of(Side::active);
  facts.sides[0].account = {"telehug", false, true};
  facts.wants_webcam = true;
  facts.cameras = {{"/dev/video0", false}};
  EXPECT_EQ(check_camera(facts).front().fix,
            "sudo usermod -aG video telehug, then sudo systemctl restart telehug-active-rig");
  facts.wants_screen = true;  // and this shell has none
  EXPECT_EQ(check_session(facts).front().level, Level::ok);
  facts.monitors = {{"DP-1", 520, 290}};
  EXPECT_THAT(
      check_calibration(facts).front().fix,
      HasSubstr("sudo -u telehug env STATE_DIRECTORY=/var/lib/telehug telehug-active calibrate --width-mm 520"));
  facts.calibration.secret = true;
  EXPECT_EQ(check_calibration(facts).front().level, Level::warn);
  EXPECT_THAT(check_calibration(facts).front().fix, HasSubstr("sudo telehug doctor"));
}

TEST(DoctorChecks, ADaemonOutOfReachIsNotTakenForAbsentNorItsPortsForAnothers) {
  DoctorFacts facts = facts_of(Side::passive);
  facts.asked_by = "mia";
  facts.udp_ports = {26660};
  facts.tcp_ports = {8080};
  facts.sides[0].web_port = 8080;
  EXPECT_EQ(check_ports(facts).size(), 2U);
  facts.sides[0].denied_socket = "/run/telehug/passive.sock";
  ASSERT_EQ(check_ports(facts).size(), 1U);
  EXPECT_EQ(check_ports(facts)[0].level, Level::ok);
  ASSERT_EQ(check_daemons(facts).size(), 1U);
  EXPECT_EQ(check_daemons(facts)[0].what,
            "telehug-passive is there, but /run/telehug/passive.sock may not be used by mia");
  EXPECT_EQ(check_daemons(facts)[0].fix, "sudo usermod -aG telehug mia, then log in again");
  // A PC's two sides share the UDP ports.
  facts.sides.push_back(facts_of(Side::active).sides[0]);
  EXPECT_EQ(check_ports(facts)[0].level, Level::ok);
}

TEST(DoctorChecks, ASideThatIsNotRootsIsLeftToWhoseItIs) {
  DoctorFacts facts = facts_of(Side::passive);
  facts.daemons.push_back(Json{{"side", "passive"}, {"peer", {{"connected", true}}}});
  facts.not_of_root = {Side::active};
  EXPECT_EQ(check_daemons(facts).front().level, Level::warn);
  EXPECT_EQ(check_daemons(facts).front().fix, "telehug doctor active, without sudo");
}

TEST(DoctorChecks, ADesktopThatSudoHidesIsNotMissed) {
  DoctorFacts facts = facts_of(Side::active);
  facts.wants_screen = true;
  EXPECT_EQ(check_session(facts).front().level, Level::fail);
  facts.through_sudo = true;
  EXPECT_EQ(check_session(facts).front().level, Level::ok);
}

TEST(DoctorChecks, LightIsJudgedByWhatTheCameraMeasures) {
  DoctorFacts facts = facts_of(Side::active);
  LightFacts& light = facts.light.emplace();
  light.mean = 0.4;
  light.asked_hz = 30;
  light.rate_hz = 29;
  EXPECT_EQ(check_light(facts).front().level, Level::ok);
  facts.light->rate_hz = 15;
  EXPECT_THAT(check_light(facts).front().what, HasSubstr("15.0 pictures a second instead of 30"));
  facts.light->rate_hz = 30;
  facts.light->flicker = 0.2;
  EXPECT_THAT(check_light(facts).front().fix, HasSubstr("camera.power_line_hz"));
  facts.light->problem = "another program uses it";
  EXPECT_EQ(check_light(facts).front().level, Level::fail);
  EXPECT_THAT(check_light(facts).front().what, HasSubstr("another program uses it"));
}

TEST(DoctorChecks, AMonitorWithoutSizeIsNoTroubleOnceItWasMeasured) {
  DoctorFacts facts = facts_of(Side::active);
  EXPECT_EQ(check_monitor(facts).front().level, Level::warn);
  facts.configured_screen_width_mm = 520;
  EXPECT_EQ(check_monitor(facts).front().level, Level::ok);
}

TEST(DoctorChecks, AMissingPairOfAServiceIsMadeByRoot) {
  DoctorFacts facts = facts_of(Side::passive);
  EXPECT_EQ(check_pairs(facts).front().fix, "telehug pair invite here, telehug pair accept on the other PC");
  facts.sides[0].account = {"telehug", false, true};
  EXPECT_EQ(check_pairs(facts).front().fix, "sudo telehug pair invite here, telehug pair accept on the other PC");
}

TEST(DoctorChecks, APairThatEndsSoonIsToldBeforeItDoes) {
  DoctorFacts facts = facts_of(Side::active);
  facts.sides[0].pairs.push_back({"0123", 13, {}});
  EXPECT_EQ(check_pairs(facts).front().level, Level::warn);
  facts.sides[0].pairs[0].days_left = 200;
  EXPECT_EQ(check_pairs(facts).front().level, Level::ok);
  facts.sides[0].pairs[0].faults = {{"the key does not fit", "telehug pair revoke 0123"}};
  EXPECT_EQ(check_pairs(facts).front().fix, "telehug pair revoke 0123");
}

TEST(DoctorChecks, WhatADaemonComplainsOfIsToldWithItsOwnFix) {
  DoctorFacts facts = facts_of(Side::active);
  facts.daemons.push_back(Json{{"side", "active"},
                               {"state", "fault"},
                               {"peer", {{"connected", false}}},
                               {"problems", {{{"what", "too dark"}, {"do", "turn on a light"}}}}});
  const Findings findings = check_daemons(facts);
  EXPECT_EQ(findings[0].level, Level::fail);
  EXPECT_EQ(findings[0].fix, "turn on a light");
  EXPECT_EQ(findings[1].check, "peer");
  EXPECT_EQ(findings[1].level, Level::warn);
  facts.daemons[0]["state"] = "waiting";
  EXPECT_EQ(check_daemons(facts)[0].level, Level::warn);
}

TEST(DoctorChecks, AnOldFirmwareIsToldWithTheCommandThatReplacesIt) {
  DoctorFacts facts = facts_of(Side::passive);
  facts.daemons.push_back(Json{{"side", "passive"}, {"jacket", {{"firmware", 2}}}});
  EXPECT_THAT(check_daemons(facts).back().fix, HasSubstr("telehug jacket flash"));
  facts.daemons[0]["jacket"]["firmware"] = newest_firmware;
  EXPECT_EQ(check_daemons(facts).back().level, Level::ok);
  facts.daemons[0]["jacket"]["firmware"] = 0;  // it answers nothing
  EXPECT_NE(check_daemons(facts).back().check, "firmware");
}

TEST(DoctorChecks, KnowTheFirmwareThatIsBuilt) {
  std::ifstream file(TELEHUG_SOURCE "/passive_side/firmware/CMakeLists.txt");
  std::string text((std::istreambuf_iterator<char>(file)), {});
  EXPECT_THAT(text, HasSubstr("set(TELEHUG_FIRMWARE_VERSION " + std::to_string(newest_firmware) + ")"));
}

TEST(DoctorChecks, ASimulatedJacketIsToldWithTheFileOfWhoseItIs) {
  DoctorFacts facts = facts_of(Side::passive);
  EXPECT_TRUE(check_jacket(facts).empty());
  facts.jacket_is_simulated = true;
  EXPECT_EQ(check_jacket(facts).front().level, Level::warn);
  EXPECT_THAT(check_jacket(facts).front().fix, HasSubstr("~/.config/telehug/passive.toml"));
  facts.sides[0].account = {"telehug", false, true};
  EXPECT_THAT(check_jacket(facts).front().fix, HasSubstr("/etc/telehug/passive.toml"));
}

TEST(DoctorChecks, SeveralPortsAreAnErrorOnlyForTheOneThatIsFoundByItself) {
  DoctorFacts facts = facts_of(Side::passive);
  facts.serial_ports = {{"/dev/a", true}, {"/dev/b", true}};
  facts.serial_port = "auto";
  EXPECT_EQ(check_serial(facts).front().level, Level::fail);
  facts.serial_port = "/dev/b";
  EXPECT_EQ(check_serial(facts).front().level, Level::ok);
}

}  // namespace
}  // namespace telehug
