// SPDX-License-Identifier: Apache-2.0
#include "ctl/doctor_checks.hpp"

#include <gmock/gmock.h>

#include <fstream>

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

TEST(DoctorChecks, AFirewallThatDropsAndHasNoRuleForTelehugFails) {
  DoctorFacts facts = facts_of(Side::passive);
  facts.may_read_firewall = true;
  facts.firewall = "chain input {\n type filter hook input priority filter; policy drop;\n}";
  EXPECT_EQ(check_firewall(facts).front().level, Level::fail);
  facts.firewall = *facts.firewall + " udp dport 26650-26679 accept";
  EXPECT_EQ(check_firewall(facts).front().level, Level::ok);
  facts.may_read_firewall = false;
  EXPECT_THAT(check_firewall(facts).front().fix, HasSubstr("sudo"));
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
                               {"peer", {{"connected", false}}},
                               {"problems", {{{"what", "too dark"}, {"do", "turn on a light"}}}}});
  const Findings findings = check_daemons(facts);
  EXPECT_EQ(findings[0].level, Level::fail);
  EXPECT_EQ(findings[0].fix, "turn on a light");
  EXPECT_EQ(findings[1].check, "peer");
  EXPECT_EQ(findings[1].level, Level::warn);
}

TEST(DoctorChecks, AnOldFirmwareIsToldWithTheCommandThatReplacesIt) {
  DoctorFacts facts = facts_of(Side::passive);
  facts.daemons.push_back(Json{{"side", "passive"}, {"jacket", {{"firmware", 2}}}});
  EXPECT_THAT(check_daemons(facts).back().fix, HasSubstr("telehug jacket flash"));
  facts.daemons[0]["jacket"]["firmware"] = newest_firmware;
  EXPECT_NE(check_daemons(facts).back().check, "firmware");
}

TEST(DoctorChecks, KnowTheFirmwareThatIsBuilt) {
  std::ifstream file(TELEHUG_SOURCE "/passive_side/firmware/CMakeLists.txt");
  std::string text((std::istreambuf_iterator<char>(file)), {});
  EXPECT_THAT(text, HasSubstr("set(TELEHUG_FIRMWARE_VERSION " + std::to_string(newest_firmware) + ")"));
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
