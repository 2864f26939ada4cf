// SPDX-License-Identifier: Apache-2.0
#include "gpio/simulated_chip.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <poll.h>
#include <sys/file.h>
#include <unistd.h>

#include <fstream>

#include "doubles/temporary_folder.hpp"

namespace telehug {
namespace {

using testing::HasSubstr;

class ASimulatedChip : public testing::Test {
 protected:
  ASimulatedChip() {
    for (const char* line : {"stop", "power"})
      set(line, "0\n");
  }
  void set(const char* line, const char* level) const { std::ofstream(folder_ / line) << level; }
  [[nodiscard]] std::string shown(const char* line) const {
    std::string level;
    std::ifstream(folder_ / line) >> level;
    return level;
  }
  [[nodiscard]] std::unique_ptr<GpioChip> chip() const {
    return std::move(open_chip("simulated:" + folder_.path().string()).value());
  }
  static bool readable(const InputLine& line) {
    pollfd watched{line.fd(), POLLIN, 0};
    return poll(&watched, 1, 0) == 1;
  }

  TemporaryFolder folder_;
  Timestamp now_ = from_ns(5'000'000'000);
};

TEST_F(ASimulatedChip, ReadsALineFromItsFile) {
  const auto line = chip()->input("stop", {});
  ASSERT_TRUE(line);
  EXPECT_FALSE((*line)->level().value());
  EXPECT_FALSE(readable(**line));
  set("stop", "1\n");
  EXPECT_TRUE(readable(**line));
  const auto change = (*line)->next(now_).value();
  ASSERT_TRUE(change);
  EXPECT_TRUE(change->active);
  EXPECT_EQ(change->time, now_);
  EXPECT_FALSE((*line)->next(now_).value());
  EXPECT_TRUE((*line)->level().value());
}

TEST_F(ASimulatedChip, TakesLowForActiveIfAsked) {
  const auto line = chip()->input("stop", {.active_low = true, .pull = Pull::none, .debounce = {}});
  EXPECT_TRUE((*line)->level().value());
  set("stop", "1");
  EXPECT_FALSE((*line)->level().value());
}

TEST_F(ASimulatedChip, DebouncesALineIfAsked) {
  const auto line = chip()->input("stop", {.active_low = false, .pull = Pull::none, .debounce = 10ms});
  set("stop", "1");
  EXPECT_FALSE((*line)->next(now_).value());
  EXPECT_FALSE((*line)->level().value());
  const auto change = (*line)->next(now_ + 10ms).value();
  ASSERT_TRUE(change);
  EXPECT_TRUE(change->active);
}

TEST_F(ASimulatedChip, WritesAnOutputToItsFile) {
  set("power", "1");
  {
    const auto line = chip()->output("power", false);
    ASSERT_TRUE(line);
    EXPECT_EQ(shown("power"), "0");
    EXPECT_TRUE((*line)->set(true));
    EXPECT_EQ(shown("power"), "1");
  }
  EXPECT_EQ(shown("power"), "0");
}

TEST_F(ASimulatedChip, WritesTheOtherLevelIfLowIsActive) {
  const auto line = chip()->output("power", true);
  EXPECT_EQ(shown("power"), "1");
  EXPECT_TRUE((*line)->set(true));
  EXPECT_EQ(shown("power"), "0");
}

TEST_F(ASimulatedChip, LocksALineForItsOwner) {
  const auto owner = chip()->output("power", false);
  EXPECT_THAT(chip()->output("power", false).error().message, HasSubstr("another program owns the line \"power\""));
  const int other = open((folder_ / "power").c_str(), O_RDONLY | O_CLOEXEC);
  EXPECT_NE(flock(other, LOCK_EX | LOCK_NB), 0);
  close(other);
}

TEST_F(ASimulatedChip, SaysWhyItOrALineCannotBeHad) {
  EXPECT_THAT(open_chip("simulated:/nowhere").error().message, HasSubstr("there is no GPIO chip"));
  EXPECT_THAT(chip()->input("hug", {}).error().message, HasSubstr("has no line \"hug\""));
}

TEST_F(ASimulatedChip, SaysThatALineIsLostWhenItsFileIsRemoved) {
  const auto input = chip()->input("stop", {});
  const auto output = chip()->output("power", false);
  std::filesystem::remove(folder_ / "stop");
  std::filesystem::remove(folder_ / "power");
  EXPECT_TRUE(readable(**input));
  EXPECT_THAT((*input)->level().error().message, HasSubstr("the line \"stop\" is lost"));
  EXPECT_THAT((*output)->set(true).error().message, HasSubstr("the line \"power\" is lost"));
}

}  // namespace
}  // namespace telehug
