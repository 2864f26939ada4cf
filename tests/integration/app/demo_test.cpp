// SPDX-License-Identifier: Apache-2.0
//
// What a new user sees first: the program behind deploy/demo.
#include <gmock/gmock.h>

#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

#include "common/clock.hpp"
#include "doubles/child_program.hpp"
#include "integration/web/raw_browser.hpp"

namespace telehug {
namespace {

using testing::HasSubstr;

constexpr auto longest_start = 60s;

std::vector<std::string> demo(std::vector<std::string> more) {
  std::vector<std::string> command{TELEHUG_BIN "/telehug-demo",
                                   "--source",
                                   "replay:" TELEHUG_FIXTURES "/rig2",
                                   "--chat-picture",
                                   TELEHUG_FIXTURES "/chat/01_full.jpg",
                                   "--profile",
                                   TELEHUG_SOURCE "/deploy/jackets/duemilanove-16.toml",
                                   "--plain"};
  command.insert(command.end(), more.begin(), more.end());
  return command;
}

TEST(TheDemo, EndsWellIfEveryPublishedTouchWasFelt) {
  ChildProgram program(demo({"--seconds", "5"}));
  std::string said;
  while (const auto line = program.read_line_within(longest_start))
    said += *line + "\n";
  EXPECT_EQ(program.wait_for_end(), 0) << said;
  EXPECT_THAT(said, HasSubstr("Every published touch was felt at the right motors."));
}

// The link in the next line that names `page`.
std::string link_after(ChildProgram& program, const std::string& page) {
  for (int lines = 0; lines < 20; ++lines) {
    const auto line = program.read_line_within(longest_start);
    if (!line) break;
    if (const auto at = line->find(page); at != std::string::npos) return line->substr(line->find("http://"));
  }
  return {};
}

TEST(TheDemo, ShowsThePagesOfBothSidesUntilItIsInterrupted) {
  ChildProgram program(demo({"--pages"}));
  for (const char* page : {"the parent's page", "the wearer's page"}) {
    const std::string link = link_after(program, page);
    const std::string start = "http://127.0.0.1:";
    ASSERT_TRUE(link.starts_with(start)) << page << ": " << link;
    const std::string host = link.substr(7, link.find('/', 7) - 7);
    RawBrowser browser(static_cast<std::uint16_t>(std::stoi(host.substr(host.find(':') + 1))));
    browser.send("GET " + link.substr(link.find('/', 7)) + " HTTP/1.1\r\nHost: " + host + "\r\n\r\n");
    EXPECT_THAT(browser.read_answer(), HasSubstr("Location: /\r\n")) << page;
  }
  ASSERT_EQ(::kill(program.pid(), SIGINT), 0);
  EXPECT_EQ(program.wait_for_end(), 0);
}

}  // namespace
}  // namespace telehug
