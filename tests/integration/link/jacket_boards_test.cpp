// SPDX-License-Identifier: Apache-2.0
//
// telehug-jacket-sim as other boards than the one with sixteen motors, in real time.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <thread>

#include "common/clock.hpp"
#include "integration/link/simulator_process.hpp"
#include "link/frame_codec.hpp"

namespace telehug {
namespace {

using protocol::FrameType;
using protocol::HeaterFault;
using ::testing::ElementsAre;

constexpr Duration patience = 20s;

// The line as a host has it that knows nothing but frames.
class Port {
 public:
  explicit Port(const std::filesystem::path& path) : fd_(open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK)) {
    if (fd_ < 0) throw std::runtime_error("can't open " + path.string());
  }
  ~Port() { close(fd_); }
  Port(const Port&) = delete;
  Port& operator=(const Port&) = delete;

  void say_bytes(std::span<const std::uint8_t> bytes) const {
    if (::write(fd_, bytes.data(), bytes.size()) != static_cast<ssize_t>(bytes.size())) {
      throw std::runtime_error("the simulator does not read");
    }
  }
  void say(FrameType type, const FramePayload& payload = {}) {
    const EncodedFrame frame = encode({type, ++sequence_, payload});
    say_bytes({frame.data(), frame.size()});
  }
  std::vector<Frame> hear() {
    std::array<std::uint8_t, 256> bytes{};
    std::vector<Frame> frames;
    const ssize_t count = ::read(fd_, bytes.data(), bytes.size());
    for (ssize_t i = 0; i < count; ++i) {
      if (auto frame = decoder_.push(bytes.at(static_cast<std::size_t>(i)))) frames.push_back(*frame);
    }
    return frames;
  }

 private:
  int fd_;
  std::uint8_t sequence_ = 0;
  FrameDecoder decoder_;
};

// Does it every 100 ms until it holds; false if it never does.
template <typename Step, typename Condition>
bool repeat_until(Step step, Condition condition) {
  const SteadyClock clock;
  for (const Timestamp deadline = clock.now() + patience; clock.now() < deadline;) {
    step();
    std::this_thread::sleep_for(100ms);
    if (condition()) return true;
  }
  return false;
}

std::set<int> channels_that_ran(const std::filesystem::path& pins) {
  std::set<int> channels;
  for (const PinLine& line : read_pins(pins))
    channels.insert(line.channel);
  return channels;
}

TEST(JacketBoards, WithHeatersTellThemAndNoteTheirPins) {
  const TemporaryFolder folder;
  const SimulatorProcess simulator(
      {"--board", "motors12_heaters2", "--link", folder / "jacket", "--pins", folder / "pins"});
  Port port(folder / "jacket");
  std::optional<protocol::Caps> caps;
  const auto warm = [&] {
    port.say(FrameType::hello, {1, 1, 0, 0});
    port.say(FrameType::heat, {1, 0x7C, 1, 25});
    for (const Frame& frame : port.hear())
      if (frame.type == FrameType::caps) caps = parse_caps(frame);
  };
  EXPECT_TRUE(repeat_until(warm, [&] { return channels_that_ran(folder / "pins").contains(17); }));
  EXPECT_THAT(channels_that_ran(folder / "pins"), ElementsAre(17));
  ASSERT_TRUE(repeat_until(warm, [&] { return caps.has_value(); }));
  EXPECT_EQ(caps->motors, 12);
  EXPECT_EQ(caps->heaters, 2);
}

TEST(JacketBoards, BreakAHeaterWhenAndHowTheyAreTold) {
  const TemporaryFolder folder;
  const SimulatorProcess simulator({"--board", "motors12_heaters2", "--link", folder / "jacket", "--supply", "4600",
                                    "--heater-fault", "0:open", "--heater-fault", "1:short@0.01"});
  Port port(folder / "jacket");
  std::optional<Frame> telemetry;
  const auto ask = [&] {
    port.say(FrameType::status);
    for (const Frame& frame : port.hear()) {
      if (frame.type == FrameType::telemetry) telemetry = frame;
    }
  };
  const auto fault = [&](std::size_t at) { return static_cast<HeaterFault>(telemetry->payload.at(at)); };
  ASSERT_TRUE(repeat_until(ask, [&] { return telemetry && fault(14) != HeaterFault::none; }));
  EXPECT_EQ(fault(14), HeaterFault::sensor_open);
  EXPECT_EQ(fault(17), HeaterFault::sensor_short);
  EXPECT_NEAR(telemetry->payload.at(10) | telemetry->payload.at(11) << 8, 4600, 25);
}

TEST(JacketBoards, OfTheOldKindRunAMotorForABareNumber) {
  const TemporaryFolder folder;
  const SimulatorProcess simulator({"--board", "legacy", "--link", folder / "jacket", "--pins", folder / "pins"});
  const Port port(folder / "jacket");
  const std::array<std::uint8_t, 1> seven{7};
  EXPECT_TRUE(
      repeat_until([&] { port.say_bytes(seven); }, [&] { return !channels_that_ran(folder / "pins").empty(); }));
  EXPECT_THAT(channels_that_ran(folder / "pins"), ElementsAre(6));
}

TEST(JacketBoards, AreRefusedWhereTheyOrTheirHeatersDoNotExist) {
  const std::vector<std::vector<std::string>> wrong{{"--board", "motors17"},
                                                    {"--heater-fault", "0:open"},
                                                    {"--board", "motors12_heaters2", "--heater-fault", "2:open"},
                                                    {"--board", "motors12_heaters2", "--heater-fault", "0:melted"},
                                                    {"--supply", "12000"}};
  for (const auto& arguments : wrong) {
    SimulatorProcess simulator(arguments);
    EXPECT_EQ(simulator.first_line(), "") << arguments.back();
    EXPECT_NE(WEXITSTATUS(simulator.end(SIGTERM)), 0) << arguments.back();
  }
}

}  // namespace
}  // namespace telehug
