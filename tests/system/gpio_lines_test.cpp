// SPDX-License-Identifier: Apache-2.0
//
// The wrapper of libgpiod on lines of the kernel. As root, with gpio-sim loaded: not on the build machine (tests/run
// --system).
#include <fcntl.h>
#include <fmt/core.h>
#include <gmock/gmock.h>
#include <poll.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <mutex>
#include <thread>

#include "gpio/panel.hpp"

namespace telehug {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

// A chip of 8 lines, labelled "telehugtest"; its wires are moved through sysfs (Linux, admin-guide/gpio/gpio-sim.rst).
class SimulatedByTheKernel : public testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directories(bank());
    write(bank() / "num_lines", "8");
    write(bank() / "label", "telehugtest");
    std::filesystem::create_directory(bank() / "line6");
    write(bank() / "line6" / "name", "STOP");
    write(config_ / "live", "1");
    chip_ = read(bank() / "chip_name");
    wires_ = std::filesystem::path("/sys/devices/platform") / read(config_ / "dev_name") / chip_;
  }
  void TearDown() override {
    if (!chip_.empty()) unplug();
    for (const auto& folder : {bank() / "line6", bank(), config_})
      std::filesystem::remove(folder);
  }
  void unplug() {
    write(config_ / "live", "0");
    chip_.clear();
  }
  [[nodiscard]] std::filesystem::path bank() const { return config_ / "bank0"; }
  [[nodiscard]] std::filesystem::path wire(int line) const { return wires_ / fmt::format("sim_gpio{}", line); }
  void pull(int line, bool up) const { write(wire(line) / "pull", up ? "pull-up" : "pull-down"); }
  [[nodiscard]] bool high(int line) const { return read(wire(line) / "value") == "1"; }

  static void write(const std::filesystem::path& file, const std::string& text) {
    std::ofstream stream(file);
    stream << text << std::flush;
    ASSERT_TRUE(stream) << file;
  }
  static std::string read(const std::filesystem::path& file) {
    std::string text;
    std::ifstream(file) >> text;
    return text;
  }
  static std::unique_ptr<GpioChip> chip() { return std::move(open_chip("telehugtest").value()); }
  // Waits for the next change.
  static LevelChange change_of(InputLine& line) {
    const SteadyClock clock;
    for (const Timestamp end = clock.now() + 10s; clock.now() < end;) {
      pollfd watched{line.fd(), POLLIN, 0};
      (void)poll(&watched, 1, 5);
      if (const auto change = line.next(clock.now()).value()) return *change;
    }
    throw std::runtime_error("the line does not change");
  }

  const std::filesystem::path config_ = "/sys/kernel/config/gpio-sim/telehug";
  std::string chip_;
  std::filesystem::path wires_;
};

TEST_F(SimulatedByTheKernel, ChipsAreFoundByPathNameAndLabel) {
  for (const std::string& name : {"/dev/" + chip_, chip_, std::string("telehugtest")}) {
    const auto found = open_chip(name);
    EXPECT_TRUE(found) << found.error().message;
  }
  EXPECT_THAT(open_chip("/dev/gpiochip99").error().message, HasSubstr("there is no GPIO chip"));
  EXPECT_FALSE(open_chip("/dev/null"));
}

TEST_F(SimulatedByTheKernel, LinesAreFoundByNumberAndName) {
  EXPECT_TRUE(chip()->input("6", {}));
  EXPECT_TRUE(chip()->input("STOP", {}));
  EXPECT_THAT(chip()->input("8", {}).error().message, HasSubstr("has no line \"8\""));
  EXPECT_THAT(chip()->input("HUG", {}).error().message, HasSubstr("has no line \"HUG\""));
}

TEST_F(SimulatedByTheKernel, LinesHaveOneOwner) {
  const auto owner = chip()->output("1", false);
  ASSERT_TRUE(owner);
  EXPECT_THAT(chip()->input("1", {}).error().message, HasSubstr("another program owns the line \"1\""));
}

TEST_F(SimulatedByTheKernel, OutputsAreInactiveFromTheirRequestOnAndLeftToTheirResistorsAtTheEnd) {
  pull(1, true);
  {
    const auto line = chip()->output("1", false);
    ASSERT_TRUE(line);
    EXPECT_FALSE(high(1));
    EXPECT_TRUE((*line)->set(true));
    EXPECT_TRUE(high(1));
    pull(1, false);
    EXPECT_TRUE(high(1)) << "it is driven";
  }
  EXPECT_FALSE(high(1));
  const auto low = chip()->output("2", true);
  ASSERT_TRUE(low);
  EXPECT_TRUE(high(2)) << "low is active";
}

TEST_F(SimulatedByTheKernel, EdgesHaveTheirTimes) {
  const SteadyClock clock;
  const auto line = chip()->input("STOP", {.active_low = true, .pull = Pull::none, .debounce = {}});
  ASSERT_TRUE(line);
  EXPECT_TRUE((*line)->level().value());
  for (const bool up : {true, false, true}) {
    const Timestamp before = clock.now();
    pull(6, up);
    const LevelChange change = change_of(**line);
    EXPECT_EQ(change.active, !up);
    EXPECT_EQ((*line)->level().value(), !up);
    EXPECT_GE(change.time, before);
    EXPECT_LE(change.time, clock.now());
  }
}

TEST_F(SimulatedByTheKernel, DebouncedLinesTellALevelThatIsStable) {
  const SteadyClock clock;
  const auto line = chip()->input("3", {.active_low = false, .pull = Pull::none, .debounce = 10ms});
  ASSERT_TRUE(line);
  const Timestamp before = clock.now();
  pull(3, true);
  const LevelChange change = change_of(**line);
  EXPECT_TRUE(change.active);
  EXPECT_GE(change.time - before, 10ms);
}

TEST_F(SimulatedByTheKernel, LinesAreLostWhenTheirChipIsUnplugged) {
  const auto input = chip()->input("3", {});
  const auto output = chip()->output("5", false);
  ASSERT_TRUE(input);
  ASSERT_TRUE(output);
  unplug();
  EXPECT_THAT((*input)->level().error().message, HasSubstr("is lost"));
  EXPECT_THAT((*output)->set(true).error().message, HasSubstr("is lost"));
}

// The whole panel on its own thread: press, let go, unplug.
TEST_F(SimulatedByTheKernel, APanelStopsForAButtonAndForItsLoss) {
  PanelOptions options;
  options.chip = "telehugtest";
  options.stop_button.line = "STOP";
  options.power.line = "5";
  auto lines = request_lines(options);
  ASSERT_TRUE(lines) << lines.error().message;
  pull(6, false);

  const SteadyClock clock;
  std::mutex mutex;
  std::vector<std::string> calls;
  Timestamp held;
  const auto note = [&](const std::string& call) {
    const std::lock_guard lock(mutex);
    calls.push_back(call);
    held = clock.now();
  };
  const auto called = [&](std::size_t count) {
    for (const Timestamp end = clock.now() + 10s; clock.now() < end; std::this_thread::sleep_for(1ms)) {
      const std::lock_guard lock(mutex);
      if (calls.size() >= count) return true;
    }
    return false;
  };
  Panel panel(*std::move(lines), options,
              {.hold = [&](const std::string& reason, const std::string&) { note(reason); },
               .release = [&] { note("release"); },
               .resume = [&] { note("resume"); },
               .stopped = [] { return false; },
               .hug = [] {}},
              clock);
  panel.start();
  panel.tell({.armed = true, .stopped = false, .sender = true, .touched = false, .problem = false}, clock.now());
  for (const Timestamp end = clock.now() + 2s; !high(5) && clock.now() < end;)
    panel.tell({.armed = true, .stopped = false, .sender = true, .touched = false, .problem = false}, clock.now());
  EXPECT_TRUE(high(5));

  const Timestamp pressed = clock.now();
  pull(6, true);
  ASSERT_TRUE(called(1));
  fmt::print("from the press to the stop, in an emulated PC: {:.1f} ms\n", to_ms(held - pressed));
  pull(6, false);
  ASSERT_TRUE(called(2));
  unplug();
  ASSERT_TRUE(called(3));
  panel.stop();
  EXPECT_THAT(calls[0], "the emergency stop button was pressed");
  EXPECT_THAT(calls[1], "release");
  EXPECT_THAT(calls[2], HasSubstr("lost"));
}

}  // namespace
}  // namespace telehug
