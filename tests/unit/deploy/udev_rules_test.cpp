// SPDX-License-Identifier: Apache-2.0
//
// The udev rules that are shipped, applied to devices as udev(7) says. `udevadm verify` is younger than Debian 12.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Key;
using ::testing::Not;
using ::testing::Pair;

using Values = std::map<std::string, std::string>;

struct Term {
  std::string key;
  std::string comparison;  // ==, != or an assignment
  std::string value;

  [[nodiscard]] bool is_match() const { return comparison == "==" || comparison == "!="; }
  [[nodiscard]] bool holds_for(const Values& device) const {
    const auto found = device.find(key);
    const bool equal = found != device.end() && found->second == value;
    return equal == (comparison == "==");
  }
};
using Rule = std::vector<Term>;

const std::filesystem::path folder = TELEHUG_SOURCE "/deploy/udev";

// Throws std::runtime_error for what udev would not understand.
Rule parse(const std::string& line) {
  static const std::regex term(R"re(\s*([A-Z]+(?:\{[A-Za-z_]+\})?)(==|!=|=|\+=)"([^"]*)"\s*(,|$))re");
  static const std::set<std::string> matched{"ACTION", "KERNEL", "SUBSYSTEM", "ATTR", "ATTRS"};
  static const std::set<std::string> assigned{"ENV", "ATTR", "GROUP", "MODE", "SYMLINK", "TAG", "OPTIONS"};
  Rule rule;
  for (auto at = line.cbegin(); at != line.cend();) {
    std::smatch found;
    if (!std::regex_search(at, line.cend(), found, term, std::regex_constants::match_continuous)) {
      throw std::runtime_error("not understood: " + std::string(at, line.cend()));
    }
    rule.push_back({found[1], found[2], found[3]});
    const std::string name = rule.back().key.substr(0, rule.back().key.find('{'));
    if (!(rule.back().is_match() ? matched : assigned).contains(name)) {
      throw std::runtime_error("no key of this kind: " + rule.back().key + rule.back().comparison);
    }
    at = found[0].second;
  }
  return rule;
}

std::vector<Rule> rules_of(const std::filesystem::path& file, const std::string& serial) {
  std::vector<Rule> rules;
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);)
    if (!line.empty() && line[0] != '#')
      rules.push_back(parse(std::regex_replace(line, std::regex("JACKET_SERIAL"), serial)));
  return rules;
}

// What the jacket's rules, installed for the one with this serial number, do to a device.
Values applied_to(const Values& device) {
  Values done;
  for (const Rule& rule : rules_of(folder / "70-telehug-jacket.rules", "A6008isP")) {
    bool holds = true;
    for (const Term& term : rule)
      if (term.is_match()) holds = holds && term.holds_for(device);
    for (const Term& term : rule)
      if (!term.is_match() && holds) done[term.key] += term.value;
  }
  return done;
}

Values with(Values device, const Values& changes) {
  for (const auto& [key, value] : changes)
    device[key] = value;
  return device;
}

const Values terminal{{"ACTION", "add"},
                      {"SUBSYSTEM", "tty"},
                      {"ATTRS{idVendor}", "0403"},
                      {"ATTRS{idProduct}", "6001"},
                      {"ATTRS{serial}", "A6008isP"}};

TEST(UdevRules, AreUnderstoodAndBothMatchAndDo) {
  std::size_t rules = 0;
  for (const auto& file : std::filesystem::directory_iterator(folder)) {
    for (const Rule& rule : rules_of(file.path(), "x")) {
      ++rules;
      EXPECT_TRUE(std::ranges::any_of(rule, &Term::is_match)) << file.path();
      EXPECT_TRUE(std::ranges::any_of(rule, std::not_fn(&Term::is_match))) << file.path();
    }
  }
  EXPECT_GE(rules, 4U);
}

TEST(UdevRules, GiveTheJacketsPortANameAndAGroup) {
  const Values done = applied_to(terminal);
  EXPECT_THAT(done, Contains(Pair("SYMLINK", "haptic-jacket")));
  EXPECT_THAT(done, Contains(Pair("GROUP", "dialout")));
  EXPECT_THAT(done, Contains(Pair("MODE", "0660")));
}

TEST(UdevRules, StartTheDaemonWhenTheJacketIsPluggedIn) {
  const Values done = applied_to(terminal);
  EXPECT_THAT(done, Contains(Pair("TAG", HasSubstr("systemd"))));
  EXPECT_THAT(done, Contains(Pair("ENV{SYSTEMD_WANTS}", "telehug-passive.service")));
}

TEST(UdevRules, LetWhoSitsAtThePcUseTheJacketsPort) {
  EXPECT_THAT(applied_to(terminal), Contains(Pair("TAG", HasSubstr("uaccess"))));
}

TEST(UdevRules, KeepModemManagerAwayBeforeItsOwnRulesAreRead) {
  EXPECT_THAT(applied_to(terminal), Contains(Pair("ENV{ID_MM_DEVICE_IGNORE}", "1")));
  const Values usb{{"ACTION", "add"},
                   {"SUBSYSTEM", "usb"},
                   {"ATTR{idVendor}", "0403"},
                   {"ATTR{idProduct}", "6001"},
                   {"ATTR{serial}", "A6008isP"}};
  EXPECT_THAT(applied_to(usb), Contains(Pair("ENV{ID_MM_DEVICE_IGNORE}", "1")));
  for (const auto& file : std::filesystem::directory_iterator(folder)) {
    const std::string number = file.path().filename().string().substr(0, 2);
    EXPECT_GT(number, "19") << file.path();
    EXPECT_LT(number, "77") << file.path();
  }
}

TEST(UdevRules, LetTheJacketsAnswersComeAtOnce) {
  EXPECT_THAT(applied_to(with(terminal, {{"SUBSYSTEM", "usb-serial"}})), Contains(Pair("ATTR{latency_timer}", "1")));
}

TEST(UdevRules, LeaveOtherDevicesWithTheSameChipAlone) {
  for (const char* subsystem : {"tty", "usb", "usb-serial"}) {
    const Values other{{"SUBSYSTEM", subsystem}, {"ATTRS{serial}", "FT123456"}, {"ATTR{serial}", "FT123456"}};
    EXPECT_THAT(applied_to(with(terminal, other)), IsEmpty()) << subsystem;
  }
  EXPECT_THAT(applied_to(with(terminal, {{"ATTRS{idProduct}", "6015"}})), IsEmpty());
  EXPECT_THAT(applied_to(with(terminal, {{"ACTION", "remove"}})), Not(Contains(Key("SYMLINK"))));
}

}  // namespace
