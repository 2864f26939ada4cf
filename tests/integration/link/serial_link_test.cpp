// SPDX-License-Identifier: Apache-2.0
//
// The links against the real firmware behind a pseudo terminal, in real time.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <set>
#include <thread>

#include "integration/link/simulator_process.hpp"
#include "link/jacket_session.hpp"
#include "link/make_link.hpp"
#include "link/simulated_link.hpp"
#include "link/wire_link.hpp"

namespace telehug {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr Duration patience = 20s;

WireLink serial_link(const std::filesystem::path& path) {
  return {std::make_unique<SerialOpener>(path, default_baud), std::make_unique<JacketSession>()};
}

// Lives through the time a daemon would: polls every 2 ms until it holds, false if it never does.
template <typename Condition>
bool poll_until(JacketLink& link, Condition condition) {
  const SteadyClock clock;
  const Timestamp deadline = clock.now() + patience;
  while (clock.now() < deadline) {
    link.poll(clock.now());
    if (condition()) return true;
    std::this_thread::sleep_for(2ms);
  }
  return false;
}

bool poll_until_armed(JacketLink& link) {
  return poll_until(link, [&link] { return link.status().state == LinkState::armed; });
}

// As poll_until, while motors 5 and 9 are to run.
template <typename Condition>
bool drive_until(JacketLink& link, Condition condition) {
  return poll_until(link, [&] {
    link.send({{5, 255, 200ms}, {9, 128, 200ms}}, SteadyClock{}.now());
    return condition();
  });
}

std::set<int> running(const std::vector<PinLine>& lines) {
  std::set<int> channels;
  for (const PinLine& line : lines) {
    if (line.on) {
      channels.insert(line.channel);
    } else {
      channels.erase(line.channel);
    }
  }
  return channels;
}

bool runs_both(const std::filesystem::path& pins) {
  return running(read_pins(pins)).size() == 2;
}

TEST(SerialLink, ArmsTheJacketAndRunsTheMotorsItIsToldAndNoOthers) {
  const TemporaryFolder folder;
  const SimulatorProcess simulator({"--link", folder / "jacket", "--pins", folder / "pins"});
  EXPECT_EQ(simulator.first_line(), "ready " + (folder / "jacket").string());
  WireLink link = serial_link(folder / "jacket");
  EXPECT_FALSE(link.send({{5, 255, 200ms}}, SteadyClock{}.now()));
  ASSERT_TRUE(poll_until_armed(link)) << link.status().problem;
  EXPECT_EQ(link.status().motor_count, 16);
  EXPECT_EQ(link.status().firmware_version, 3);
  EXPECT_EQ(link.status().problem, "");
  ASSERT_TRUE(drive_until(link, [&] { return runs_both(folder / "pins"); }));
  EXPECT_THAT(running(read_pins(folder / "pins")), ElementsAre(5, 9));
  link.stop_all(SteadyClock{}.now());
  EXPECT_TRUE(poll_until(link, [&] { return running(read_pins(folder / "pins")).empty(); }));
  for (const PinLine& line : read_pins(folder / "pins"))
    EXPECT_THAT(line.channel, ::testing::AnyOf(5, 9));
  EXPECT_EQ(link.status().nacks, 0U);
  EXPECT_EQ(link.status().malformed_frames, 0U);
  EXPECT_EQ(link.status().state, LinkState::armed);
}

TEST(SerialLink, ArmsByItselfAgainWhenTheJacketComesBackUnderAnotherTerminal) {
  const TemporaryFolder folder;
  auto first = std::make_unique<SimulatorProcess>(std::vector<std::string>{"--link", folder / "jacket"});
  const auto first_terminal = std::filesystem::read_symlink(folder / "jacket");
  // Keeps the number of the first terminal taken.
  const int held = open(first_terminal.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
  WireLink link = serial_link(folder / "jacket");
  ASSERT_TRUE(poll_until_armed(link));
  first->end(SIGKILL);
  ASSERT_TRUE(poll_until(link, [&] { return link.status().state == LinkState::absent; }));
  EXPECT_THAT(link.status().problem, HasSubstr((folder / "jacket").string()));
  EXPECT_FALSE(link.send({{5, 255, 200ms}}, SteadyClock{}.now()));

  const SimulatorProcess second({"--link", folder / "jacket", "--pins", folder / "pins"});
  EXPECT_NE(std::filesystem::read_symlink(folder / "jacket"), first_terminal);
  ASSERT_TRUE(poll_until_armed(link)) << link.status().problem;
  EXPECT_EQ(link.status().reconnects, 1U);
  EXPECT_TRUE(drive_until(link, [&] { return runs_both(folder / "pins"); }));
  close(held);
}

TEST(SerialLink, FindsTheOnlyJacketAgainUnderAnotherName) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "by-id");
  WireLink link(std::make_unique<SerialOpener>("auto", default_baud, folder / "by-id"),
                std::make_unique<JacketSession>());
  auto first = std::make_unique<SimulatorProcess>(std::vector<std::string>{"--link", folder / "by-id/usb-A"});
  ASSERT_TRUE(poll_until_armed(link)) << link.status().problem;
  EXPECT_EQ(link.status().device, (folder / "by-id/usb-A").string());
  // Pulled while frames leave.
  for (int i = 0; i < 50; ++i)
    link.stop_all(SteadyClock{}.now());
  first->end(SIGKILL);
  ASSERT_TRUE(poll_until(link, [&] { return link.status().state == LinkState::absent; }));
  std::filesystem::remove(folder / "by-id/usb-A");

  const SimulatorProcess second({"--link", folder / "by-id/usb-B", "--pins", folder / "pins"});
  ASSERT_TRUE(poll_until_armed(link)) << link.status().problem;
  EXPECT_EQ(link.status().device, (folder / "by-id/usb-B").string());
  EXPECT_EQ(link.status().reconnects, 1U);
  EXPECT_TRUE(drive_until(link, [&] { return runs_both(folder / "pins"); }));
  EXPECT_THAT(running(read_pins(folder / "pins")), ElementsAre(5, 9));
}

TEST(SerialLink, LeavesNoMotorRunningWhenTheFirmwaresInputIsCut) {
  const TemporaryFolder folder;
  SimulatorProcess simulator({"--link", folder / "jacket", "--pins", folder / "pins"});
  WireLink link = serial_link(folder / "jacket");
  ASSERT_TRUE(poll_until_armed(link));
  ASSERT_TRUE(drive_until(link, [&] { return runs_both(folder / "pins"); }));
  simulator.signal(SIGUSR1);
  const std::string muted = simulator.read_line();
  ASSERT_THAT(muted, ::testing::StartsWith("muted "));
  const std::int64_t muted_ns = std::stol(muted.substr(6));
  ASSERT_TRUE(drive_until(link, [&] { return running(read_pins(folder / "pins")).empty(); }));
  const auto lines = read_pins(folder / "pins");
  const auto last = std::ranges::max(lines, {}, &PinLine::monotonic_ns);
  const double off_after_ms = static_cast<double>(last.monotonic_ns - muted_ns) / 1e6;
  std::cout << "all pins off " << off_after_ms << " ms after the input was cut\n";
  RecordProperty("off_after_ms", std::to_string(off_after_ms));
  EXPECT_LE(off_after_ms, 600) << "twice the limit of 300 ms";
  // It tells that the jacket has fallen silent, and recovers with it.
  EXPECT_TRUE(poll_until(link, [&] { return link.status().state == LinkState::connecting; }));
  simulator.signal(SIGUSR1);
  EXPECT_TRUE(poll_until_armed(link));
  EXPECT_TRUE(drive_until(link, [&] { return runs_both(folder / "pins"); }));
}

TEST(SerialLink, RefusesAPortThatAnotherLinkHolds) {
  const TemporaryFolder folder;
  const SimulatorProcess simulator({"--link", folder / "jacket"});
  WireLink first = serial_link(folder / "jacket");
  ASSERT_TRUE(poll_until_armed(first));
  WireLink second = serial_link(folder / "jacket");
  second.poll(SteadyClock{}.now());
  EXPECT_EQ(second.status().state, LinkState::absent);
  EXPECT_THAT(second.status().problem, HasSubstr("close the program that uses it"));
}

TEST(SimulatedLink, StartsItsJacketAndStartsItAgainAfterItsDeath) {
  const TemporaryFolder folder;
  SimulatorOptions options;
  options.program = TELEHUG_BIN "/telehug-jacket-sim";
  options.pins = folder / "pins";
  SimulatedLink link(options, std::make_unique<JacketSession>());
  ASSERT_TRUE(poll_until_armed(link)) << link.status().problem;
  EXPECT_TRUE(drive_until(link, [&] { return runs_both(folder / "pins"); }));
  kill(link.simulator(), SIGKILL);
  ASSERT_TRUE(poll_until(link, [&] { return link.status().state == LinkState::absent; }));
  ASSERT_TRUE(poll_until_armed(link)) << link.status().problem;
  EXPECT_EQ(link.status().reconnects, 1U);
}

TEST(JacketSimulator, EndsOnSigtermWithSuccessAndTakesItsLinkAway) {
  const TemporaryFolder folder;
  SimulatorProcess simulator({"--link", folder / "jacket"});
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "jacket"));
  EXPECT_EQ(simulator.end(SIGTERM), 0);
  EXPECT_FALSE(std::filesystem::is_symlink(folder / "jacket"));
}

TEST(JacketSimulator, SaysThatAFirmwareIsMissing) {
  const TemporaryFolder folder;
  SimulatorProcess simulator({"--firmware", folder / "none.elf", "--link", folder / "jacket"});
  EXPECT_EQ(simulator.first_line(), "");
  EXPECT_EQ(WEXITSTATUS(simulator.end(SIGTERM)), 1);
}

}  // namespace
}  // namespace telehug
