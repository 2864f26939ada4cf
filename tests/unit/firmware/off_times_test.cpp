// SPDX-License-Identifier: Apache-2.0
//
// How long the outputs stay on after something has gone wrong: the real firmware, measured in its own cycles, at
// several moments of its period; the worst counts. Prints a table.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <iostream>
#include <random>

#include "unit/firmware/warm_jacket.hpp"

namespace telehug {
namespace {

using protocol::FrameType;
using Bytes = std::vector<std::uint8_t>;

constexpr double limit_ms = 300;
constexpr std::uint8_t full = 255;
constexpr std::uint8_t everything = jacket_outputs;

// Twelve motors and two heaters that run, as an eager host has them.
class DrivenJacket : public WarmJacket {
 public:
  static constexpr std::size_t outputs = 14;

  explicit DrivenJacket(std::uint64_t phase_ms) {
    hello();
    drive();
    run_ms(20 + phase_ms);
    EXPECT_EQ(channels_that_rose_since(0).size(), outputs);
  }

  Frame set_all(std::uint8_t intensity) {
    FramePayload payload(16, 0);
    std::fill_n(payload.begin(), 12, intensity);
    payload.push_back(250);
    payload.push_back(0);
    return {FrameType::set_all, ++sequence, payload};
  }
  void drive() {
    hold({40, 40});
    say(set_all(full));
  }
  // As a host that notices nothing.
  void drive_on_for(double seconds) {
    const auto from = chip.cycle();
    while (to_ms(chip.cycle() - from) < 1000 * seconds) {
      drive();
      run_ms(50);
    }
  }

  // From `cycle` until the last moment in which the channel (or any) was high.
  [[nodiscard]] double off_after_ms(std::uint64_t cycle, std::uint8_t channel = everything) const {
    std::uint64_t last = cycle;
    for (std::uint8_t each = 0; each < jacket_outputs; ++each) {
      if (channel == everything || channel == each) last = std::max(last, last_high(each));
    }
    return to_ms(last - cycle);
  }
};

// Brings the fault about and returns after how long all was off.
using Fault = std::function<double(DrivenJacket&)>;

const std::vector<std::uint64_t> many_phases_ms{0, 3, 8, 14, 21, 29};
const std::vector<std::uint64_t> few_phases_ms{0, 14};  // for what takes long

double off_after(const Fault& fault, const std::vector<std::uint64_t>& phases_ms) {
  double worst = 0;
  for (const std::uint64_t phase_ms : phases_ms) {
    DrivenJacket jacket(phase_ms);
    worst = std::max(worst, fault(jacket));
  }
  return worst;
}

// The line carries these and nothing else for a second.
Fault only_hears(const std::function<Bytes(DrivenJacket&)>& bytes) {
  return [bytes](DrivenJacket& jacket) {
    jacket.drive();
    const auto from = jacket.chip.cycle();
    while (to_ms(jacket.chip.cycle() - from) < 1000) {
      jacket.say_bytes(bytes(jacket));
      jacket.run_ms(1);
    }
    return jacket.off_after_ms(from);
  };
}

Bytes bytes_of(const Frame& frame) {
  const EncodedFrame encoded = encode(frame);
  return {encoded.begin(), encoded.end()};
}

double never_driven_again(DrivenJacket& jacket, std::uint64_t from) {
  jacket.drive_on_for(1);
  EXPECT_EQ(jacket.ask(FrameType::keep)->type, FrameType::nack) << "needs a hello";
  const double off_ms = jacket.off_after_ms(from);
  jacket.hello();
  jacket.drive();
  jacket.run_ms(100);
  EXPECT_TRUE(jacket.anything_high());
  return off_ms;
}

Fault sensor(HeaterBreak what) {
  return [what](DrivenJacket& jacket) {
    jacket.break_now(0, what);
    const auto from = jacket.chip.cycle();
    jacket.drive_on_for(3);
    EXPECT_TRUE(jacket.chip.is_high(0)) << "motors go on";
    return jacket.off_after_ms(from, first_heater_channel);
  };
}

class OffTimes : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    std::cout << fmt::format("{:<56} {:>12} {:>9}\n", "fault", "off after ms", "limit ms");
  }

  static void expect_off(const std::string& fault, double most_ms, const Fault& bring_about,
                         const std::vector<std::uint64_t>& phases_ms = many_phases_ms) {
    const double off_ms = off_after(bring_about, phases_ms);
    std::cout << fmt::format("{:<56} {:>12.1f} {:>9.0f}\n", fault, off_ms, most_ms);
    EXPECT_LE(off_ms, most_ms) << fault;
  }
};

TEST_F(OffTimes, WhenTheLineCarriesNoGoodFrame) {
  expect_off("the cable is pulled", limit_ms, [](DrivenJacket& jacket) {
    jacket.drive();
    const auto from = jacket.chip.cycle();
    jacket.chip.mute_input(true);
    jacket.run_ms(1000);
    return jacket.off_after_ms(from);
  });
  std::mt19937 random(1);
  expect_off("garbage", limit_ms, only_hears([&random](DrivenJacket&) {
               Bytes bytes(40);
               std::ranges::generate(bytes, [&] { return static_cast<std::uint8_t>(random() & 0xFFU); });
               return bytes;
             }));
  expect_off("frames that are cut short", limit_ms, only_hears([](DrivenJacket& jacket) {
               Bytes bytes = bytes_of(jacket.set_all(full));
               bytes.resize(bytes.size() / 2);
               return bytes;
             }));
  expect_off("frames with a wrong bit", limit_ms, only_hears([&random](DrivenJacket& jacket) {
               Bytes bytes = bytes_of(jacket.set_all(full));
               bytes[random() % (bytes.size() - 1)] ^= static_cast<std::uint8_t>(1U << random() % 8);
               return bytes;
             }));
  expect_off("frames that are too long", limit_ms, only_hears([](DrivenJacket& jacket) {
               Bytes bytes = bytes_of(jacket.set_all(full));
               bytes.insert(bytes.begin(), 80, 0x11);
               return bytes;
             }));
  expect_off("the last frame again and again", limit_ms, only_hears([](DrivenJacket& jacket) {
               const std::uint8_t last = jacket.sequence;
               Frame frame = jacket.set_all(full);
               frame.sequence = jacket.sequence = last;
               return bytes_of(frame);
             }));
}

TEST_F(OffTimes, WhenFramesComeInTheWrongOrder) {
  expect_off("an old drive comes after the newer end, then silence", 1, [](DrivenJacket& jacket) {
    const Frame old = jacket.set_all(full);
    jacket.say(jacket.set_all(0));
    const auto from = jacket.say(old);
    jacket.run_ms(1000);
    return jacket.off_after_ms(from, 0);
  });
}

TEST_F(OffTimes, WhenTheHostSaysSo) {
  expect_off("stop_all", 1, [](DrivenJacket& jacket) {
    const auto from = jacket.say(FrameType::stop_all);
    jacket.run_ms(400);
    return jacket.off_after_ms(from);
  });
  expect_off("hello of another host", 1, [](DrivenJacket& jacket) {
    const auto from = jacket.say(FrameType::hello, {1, 1, 0, 0});
    jacket.run_ms(400);
    return jacket.off_after_ms(from);
  });
}

TEST_F(OffTimes, WhenTheFirmwareFails) {
  expect_off("the main loop hangs", limit_ms, [](DrivenJacket& jacket) {
    jacket.chip.hang_main_loop();
    const double off_ms = never_driven_again(jacket, jacket.chip.cycle());
    EXPECT_EQ(jacket.chip.resets(), 1U);
    return off_ms;
  });
  expect_off("the timer stops", limit_ms, [](DrivenJacket& jacket) {
    jacket.chip.stop_timer();
    const double off_ms = never_driven_again(jacket, jacket.chip.cycle());
    EXPECT_EQ(jacket.chip.resets(), 1U);
    return off_ms;
  });
  expect_off("a reset, by the port or a low supply", limit_ms, [](DrivenJacket& jacket) {
    const auto from = jacket.chip.cycle();
    jacket.chip.reset();
    return never_driven_again(jacket, from);
  });
}

TEST_F(OffTimes, WhenAThermistorOrAHeaterFails) {
  expect_off("a thermistor's cable is cut", limit_ms, sensor(HeaterBreak::open));
  expect_off("a thermistor is shorted", limit_ms, sensor(HeaterBreak::shorted));
  expect_off(
      "a pad has 41 C because its transistor always conducts", limit_ms,
      [](DrivenJacket& jacket) {
        HeatedPatch& other = jacket.chip.heaters().patch(1);
        other.parameters.skin_celsius = 26;  // takes two minutes to get warm
        jacket.run_heated_s(30, {40, 40});
        jacket.break_now(0, HeaterBreak::runaway);
        const auto reached = [&] { return jacket.chip.heaters().patch(0).sensor_celsius() >= 41; };
        const bool too_late = jacket.ms_until(reached, {40, 40}, 45).has_value();
        const auto from = jacket.chip.cycle();
        jacket.run_heated_s(2, {40, 40});
        EXPECT_EQ(jacket.heater_telemetry(1).fault, protocol::HeaterFault::too_hot);
        return too_late ? jacket.off_after_ms(from, 17) : 0;
      },
      few_phases_ms);
  // These take as long as it takes to see them in the temperature.
  expect_off(
      "a thermistor has come off", 10'000,
      [](DrivenJacket& jacket) {
        jacket.break_now(0, HeaterBreak::detached);
        const auto from = jacket.chip.cycle();
        jacket.run_heated_s(20, {40, 40});
        return jacket.off_after_ms(from, 16);
      },
      few_phases_ms);
  expect_off(
      "a heater gets 14 V", 5'000,
      [](DrivenJacket& jacket) {
        jacket.break_now(0, HeaterBreak::overvoltage);
        const auto from = jacket.chip.cycle();
        jacket.run_heated_s(10, {40, 40});
        return jacket.off_after_ms(from, 16);
      },
      few_phases_ms);
}

}  // namespace
}  // namespace telehug
