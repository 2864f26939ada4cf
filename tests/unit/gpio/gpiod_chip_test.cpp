// SPDX-License-Identifier: Apache-2.0
//
// The lines of a kernel's chip: built once for each version of libgpiod, over the same fake kernel.
#include "gpio/gpiod_chip.hpp"

#include <gmock/gmock.h>
#include <poll.h>

#include "doubles/fake_gpio_kernel.hpp"

namespace telehug {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class AChipOfTheKernel : public testing::Test {
 protected:
  void SetUp() override { kernel_.reset(); }
  void TearDown() override { EXPECT_EQ(kernel_.open_chips, 0) << "of the library's objects are left"; }

  static std::unique_ptr<GpioChip> chip() { return std::move(open_gpiod_chip("gpiochip0").value()); }
  static std::string why_not(const std::string& name) {
    const auto chip = open_gpiod_chip(name);
    return chip ? "it works" : chip.error().message;
  }
  static bool readable(const InputLine& line) {
    pollfd watched{line.fd(), POLLIN, 0};
    return poll(&watched, 1, 0) == 1;
  }

  FakeGpioKernel& kernel_ = FakeGpioKernel::get();
  Timestamp now_ = from_ns(5'000'000'000);
};

TEST_F(AChipOfTheKernel, IsFoundByPathAndByName) {
  EXPECT_TRUE(open_gpiod_chip("/dev/gpiochip0"));
  EXPECT_TRUE(open_gpiod_chip("gpiochip0"));
}

TEST_F(AChipOfTheKernel, SaysWhyItCannotBeOpened) {
  EXPECT_THAT(why_not("/dev/gpiochip7"), HasSubstr("there is no GPIO chip \"/dev/gpiochip7\""));
  EXPECT_THAT(why_not("nothing"), HasSubstr("there is no GPIO chip \"nothing\""));
  kernel_.open_error = EACCES;
  EXPECT_THAT(why_not("/dev/gpiochip0"), HasSubstr("add the user to the group gpio"));
  kernel_.open_error = ENOTTY;
  EXPECT_THAT(why_not("/dev/gpiochip0"), HasSubstr("is no GPIO chip"));
}

TEST_F(AChipOfTheKernel, TakesLinesByNumberAndByName) {
  const auto first = chip()->input("2", {});
  const auto second = chip()->output("line3", false);
  ASSERT_TRUE(first);
  ASSERT_TRUE(second);
  EXPECT_EQ(kernel_.lines[2].consumer, "telehug-passive");
  EXPECT_TRUE(kernel_.lines[2].both_edges);
  EXPECT_FALSE(kernel_.lines[2].output);
  EXPECT_TRUE(kernel_.lines[3].output);
}

TEST_F(AChipOfTheKernel, SaysWhyALineCannotBeHad) {
  const auto owner = chip()->output("1", false);
  const auto why = [](const std::string& line) { return chip()->input(line, {}).error().message; };
  EXPECT_THAT(why("1"), HasSubstr("another program owns the line \"1\""));
  EXPECT_THAT(why("9"), HasSubstr("has no line \"9\""));
  EXPECT_THAT(why("stop"), HasSubstr("has no line \"stop\""));
  kernel_.request_error = EPERM;
  EXPECT_THAT(why("2"), HasSubstr("add the user to the group gpio"));
}

TEST_F(AChipOfTheKernel, DrivesAnOutputToItsInactiveLevelInTheRequestItself) {
  kernel_.lines[0].high = true;
  kernel_.lines[1].high = false;
  const auto high = chip()->output("0", false);
  const auto low = chip()->output("1", true);
  EXPECT_THAT(kernel_.lines[0].driven, ElementsAre(false));
  EXPECT_THAT(kernel_.lines[1].driven, ElementsAre(true));
}

TEST_F(AChipOfTheKernel, DrivesAnOutputWithItsPolarity) {
  const auto line = chip()->output("1", true);
  ASSERT_TRUE(line);
  EXPECT_TRUE((*line)->set(true));
  EXPECT_TRUE((*line)->set(false));
  EXPECT_THAT(kernel_.lines[1].driven, ElementsAre(true, false, true));
}

TEST_F(AChipOfTheKernel, LeavesAnOutputInactiveWhenItGoes) {
  {
    const auto line = chip()->output("1", false);
    ASSERT_TRUE((*line)->set(true));
  }
  EXPECT_THAT(kernel_.lines[1].driven, ElementsAre(false, true, false));
  EXPECT_EQ(kernel_.lines[1].consumer, "") << "the line was not released";
}

TEST_F(AChipOfTheKernel, TellsEdgesWithTheirTimes) {
  const auto line = chip()->input("0", {.active_low = true, .pull = Pull::up, .debounce = {}});
  ASSERT_TRUE(line);
  EXPECT_EQ(kernel_.lines[0].pull, 1);
  EXPECT_TRUE((*line)->level().value()) << "low is active";
  EXPECT_FALSE(readable(**line));
  EXPECT_FALSE((*line)->next(now_).value());

  kernel_.move(0, true, 4'000'000'001);
  kernel_.move(0, false, 4'100'000'002);
  EXPECT_TRUE(readable(**line));
  const auto first = (*line)->next(now_).value();
  ASSERT_TRUE(first);
  EXPECT_FALSE(first->active);
  EXPECT_EQ(to_ns(first->time), 4'000'000'001);
  const auto second = (*line)->next(now_).value();
  ASSERT_TRUE(second);
  EXPECT_TRUE(second->active);
  EXPECT_EQ(to_ns(second->time), 4'100'000'002);
  EXPECT_FALSE((*line)->next(now_).value());
}

TEST_F(AChipOfTheKernel, PullsALineDownIfAsked) {
  const auto line = chip()->input("0", {.active_low = false, .pull = Pull::down, .debounce = {}});
  EXPECT_EQ(kernel_.lines[0].pull, -1);
}

// Version 2 leaves it to the kernel, whose fake here does not bounce.
TEST_F(AChipOfTheKernel, DebouncesALineIfAsked) {
  const auto line = chip()->input("0", {.active_low = false, .pull = Pull::none, .debounce = 10ms});
  ASSERT_TRUE(line);
  if (kernel_.lines[0].debounce_us != 0) {
    EXPECT_EQ(kernel_.lines[0].debounce_us, 10'000);
    return;
  }
  kernel_.move(0, true, to_ns(now_));
  EXPECT_FALSE((*line)->next(now_).value());
  EXPECT_EQ((*line)->due(), now_ + 10ms);
  kernel_.move(0, false, to_ns(now_ + 2ms));
  kernel_.move(0, true, to_ns(now_ + 4ms));
  EXPECT_FALSE((*line)->next(now_ + 12ms).value());
  EXPECT_FALSE((*line)->level().value());
  const auto change = (*line)->next(now_ + 14ms).value();
  ASSERT_TRUE(change);
  EXPECT_TRUE(change->active);
  EXPECT_EQ(change->time, now_ + 14ms);
  EXPECT_TRUE((*line)->level().value());
  EXPECT_FALSE((*line)->next(now_ + 15ms).value());

  // A whole release that is told of late.
  kernel_.move(0, false, to_ns(now_ + 100ms));
  kernel_.move(0, true, to_ns(now_ + 150ms));
  const auto let_go = (*line)->next(now_ + 200ms).value();
  ASSERT_TRUE(let_go);
  EXPECT_FALSE(let_go->active);
  EXPECT_EQ(let_go->time, now_ + 110ms);
  const auto pressed = (*line)->next(now_ + 200ms).value();
  ASSERT_TRUE(pressed);
  EXPECT_TRUE(pressed->active);
}

TEST_F(AChipOfTheKernel, SaysThatALineIsLostWhenItIsUnplugged) {
  const auto input = chip()->input("0", {});
  const auto output = chip()->output("1", false);
  ASSERT_TRUE(input);
  ASSERT_TRUE(output);
  kernel_.gone = true;
  EXPECT_THAT((*input)->level().error().message, HasSubstr("the line \"0\" is lost"));
  EXPECT_THAT((*output)->set(true).error().message, HasSubstr("the line \"1\" is lost"));
}

}  // namespace
}  // namespace telehug
