// SPDX-License-Identifier: Apache-2.0
#include "link/make_link.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "doubles/fake_clock.hpp"
#include "unit/jacket/jacket_builders.hpp"

namespace telehug {
namespace {

using ::testing::HasSubstr;

std::filesystem::path temporary_file() {
  return std::filesystem::path(::testing::TempDir()) / ("telehug-recording-" + std::to_string(getpid()) + ".csv");
}

TEST(MakeLink, SaysWhatItTakesWhenASpecNamesNoJacket) {
  for (const char* spec : {"", "serial", "serial:", "record:", "bluetooth", "simulated:x",
                           "rfcomm:", "rfcomm:00:11:22:33:44", "rfcomm:00:11:22:33:44:55/0"}) {
    const auto link = make_link(spec);
    ASSERT_FALSE(link) << spec;
    EXPECT_THAT(link.error().message, HasSubstr("serial:PATH, rfcomm:ADDRESS, simulated or record:FILE")) << spec;
  }
}

TEST(MakeLink, MakesASerialLinkThatTellsWhyItsPortDoesNotOpen) {
  const FakeClock clock;
  auto link = make_link("serial:/nonexistent/jacket");
  ASSERT_TRUE(link);
  (*link)->poll(clock.now());
  EXPECT_EQ((*link)->status().state, LinkState::absent);
  EXPECT_EQ((*link)->status().device, "/nonexistent/jacket");
  EXPECT_THAT((*link)->status().problem, HasSubstr("plug the jacket in"));
}

TEST(MakeLink, MakesABluetoothLink) {
  const auto link = make_link("rfcomm:00:11:22:33:44:55/3");
  ASSERT_TRUE(link);
  EXPECT_EQ((*link)->status().device, "00:11:22:33:44:55");
  EXPECT_EQ((*link)->status().state, LinkState::absent);
}

TEST(MakeLink, LooksForTheOnlySerialDevice) {
  const auto link = make_link("serial:auto");
  ASSERT_TRUE(link);
  EXPECT_EQ((*link)->status().device, "serial:auto");
}

TEST(MakeLink, SpeaksAsTheProfileSays) {
  JacketProfile profile = profile_of({motor(1, {}, {})});
  EXPECT_TRUE((*make_link("serial:/dev/null", link_options(profile)))->status().answers);
  profile.protocol = JacketProtocol::legacy;
  EXPECT_FALSE((*make_link("serial:/dev/null", link_options(profile)))->status().answers);
  EXPECT_FALSE((*make_link("rfcomm:00:11:22:33:44:55/3", link_options(profile)))->status().answers);
}

TEST(MakeLink, TakesTheSpeedOfTheProfileUnlessItIsGivenAnother) {
  JacketProfile profile = profile_of({motor(1, {}, {})});
  profile.baud = 38400;
  EXPECT_EQ(link_options(profile).baud, 38400U);
  EXPECT_EQ(link_options(profile, 9600).baud, 9600U);
}

TEST(MakeLink, SimulatesTheBoardThatTheProfileNeeds) {
  JacketProfile profile = profile_of({motor(1, {}, {}), motor(2, {}, {})});
  EXPECT_EQ(link_options(profile).simulator.board, "motors16");
  profile.actuators[1].kind = ActuatorKind::heater;
  EXPECT_EQ(link_options(profile).simulator.board, "motors12_heaters2");
  profile.actuators.pop_back();
  profile.protocol = JacketProtocol::legacy;
  EXPECT_EQ(link_options(profile).simulator.board, "legacy");
}

TEST(MakeLink, TellsThatAFileIsNoSerialPort) {
  const FakeClock clock;
  auto link = make_link("serial:/dev/null");
  ASSERT_TRUE(link);
  (*link)->poll(clock.now());
  EXPECT_THAT((*link)->status().problem, HasSubstr("/dev/null is not a serial port"));
}

TEST(MakeLink, TellsThatASpeedIsNone) {
  const FakeClock clock;
  auto link = make_link("serial:/dev/null", {.baud = 12345, .protocol = LinkProtocol::telehug, .simulator = {}});
  ASSERT_TRUE(link);
  (*link)->poll(clock.now());
  EXPECT_THAT((*link)->status().problem, HasSubstr("12345 baud"));
}

TEST(MakeLink, SaysThatTheSimulatorIsMissing) {
  LinkOptions options;
  options.simulator.program = "/nonexistent/telehug-jacket-sim";
  const auto link = make_link("simulated", options);
  ASSERT_FALSE(link);
  EXPECT_THAT(link.error().message, HasSubstr("/nonexistent/telehug-jacket-sim"));
}

TEST(MakeLink, SaysThatARecordingCantBeWritten) {
  const auto link = make_link("record:/nonexistent/commands.csv");
  ASSERT_FALSE(link);
  EXPECT_THAT(link.error().message, HasSubstr("/nonexistent/commands.csv"));
}

TEST(RecordingLink, IsNoJacketAnyMoreWhenTheDiskIsFull) {
  const FakeClock clock;
  auto link = make_link("record:/dev/full");
  ASSERT_TRUE(link);
  for (int i = 0; i < 1000; ++i)
    EXPECT_FALSE((*link)->send({{3, 255, 150ms}}, clock.now()));
  (*link)->stop_all(clock.now());
  EXPECT_EQ((*link)->status().state, LinkState::absent);
  EXPECT_THAT((*link)->status().problem, HasSubstr("/dev/full: No space left on device"));
}

TEST(RecordingLink, WritesEveryCommandWithItsTime) {
  FakeClock clock;
  const auto file = temporary_file();
  auto link = make_link("record:" + file.string());
  ASSERT_TRUE(link);
  EXPECT_EQ((*link)->status().state, LinkState::armed);
  EXPECT_TRUE((*link)->send({{3, 255, 150ms}, {7, 9, 20ms}}, clock.now()));
  clock.advance(1ms);
  EXPECT_TRUE((*link)->send({}, clock.now()));
  EXPECT_TRUE((*link)->heat({{1, 38.5, 150ms}}, clock.now()));
  (*link)->stop_all(clock.now());
  std::stringstream content;
  content << std::ifstream(file).rdbuf();
  std::filesystem::remove(file);
  EXPECT_EQ(content.str(),
            "monotonic_ns,command,channel,intensity,duration_ms\n"
            "1000000000,set,3,255,150.000\n"
            "1000000000,set,7,9,20.000\n"
            "1001000000,off,,,\n"
            "1001000000,heat,1,38.5,150.000\n"
            "1001000000,stop,,,\n");
}

}  // namespace
}  // namespace telehug
