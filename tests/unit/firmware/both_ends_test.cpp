// SPDX-License-Identifier: Apache-2.0
//
// The host's session and the real firmware, byte by byte at the line's speed, in virtual time.
#include <gtest/gtest.h>

#include <array>
#include <random>

#include "link/jacket_session.hpp"
#include "simulator/simulated_jacket.hpp"

namespace telehug {
namespace {

class BothEnds : public ::testing::Test {
 protected:
  BothEnds() {
    chip.run_ms(5);  // has been switched on before
    session.connected(now());
  }

  [[nodiscard]] Timestamp now() const {
    return from_ns(1'000'000'000 + static_cast<std::int64_t>(chip.cycle() * 125 / 2));
  }

  void run_one_ms() {
    for (;;) {
      const EncodedFrame frame = session.next_frame(now(), chip.bytes_in_flight() > 64);
      if (frame.empty()) break;
      chip.write({frame.data(), frame.size()});
    }
    chip.run_ms(1);
    session.receive(chip.take_output(), now());
  }

  void run_until_armed() {
    for (int ms = 0; ms < 1000 && !session.armed(); ++ms)
      run_one_ms();
    ASSERT_TRUE(session.armed());
  }

  SimulatedJacket chip{TELEHUG_FIRMWARE_ELF};
  JacketSession session;
};

TEST_F(BothEnds, ArmEachOtherWithin50Milliseconds) {
  int ms = 0;
  while (!session.armed() && ms < 1000) {
    run_one_ms();
    ++ms;
  }
  EXPECT_LE(ms, 50);
  EXPECT_TRUE(chip.armed_led());
}

TEST_F(BothEnds, StayArmedWithNothingToDo) {
  run_until_armed();
  for (int ms = 0; ms < 3000; ++ms) {
    run_one_ms();
    ASSERT_TRUE(chip.armed_led());
  }
  EXPECT_EQ(session.status().nacks, 0U);
  EXPECT_EQ(session.status().reconnects, 0U);
}

// A state may need 22 ms until it is sent, 1 ms behind a shorter frame, 10 ms on the line and 2 ms to the pins.
TEST_F(BothEnds, RunExactlyTheMotorsThatTheNewestStatesName) {
  run_until_armed();
  constexpr Duration delay = 38ms;
  std::mt19937 random(3);
  std::uniform_int_distribution<int> percent(0, 99);
  std::array<Timestamp, protocol::motor_count> named_until{};
  std::array<Timestamp, protocol::motor_count> named_since{};
  MotorCommands state;
  for (int ms = 0; ms < 6000; ++ms) {
    if (percent(random) < 4) {
      state.clear();
      for (std::uint8_t channel = 0; channel < protocol::motor_count; ++channel) {
        if (percent(random) < 30) state.push_back({channel, 255, 100ms});
      }
    }
    if (ms % 7 == 0) {
      ASSERT_TRUE(session.send(state, now()));
      std::array<bool, protocol::motor_count> named{};
      for (const MotorCommand& command : state)
        named.at(command.channel) = true;
      for (std::size_t channel = 0; channel < named.size(); ++channel) {
        if (named.at(channel)) named_until.at(channel) = now() + 7ms;
        if (!named.at(channel)) named_since.at(channel) = now();
      }
    }
    run_one_ms();
    for (std::uint8_t channel = 0; channel < protocol::motor_count; ++channel) {
      if (chip.is_high(channel)) {
        ASSERT_LE(now(), named_until.at(channel) + delay) << "channel " << int{channel} << " at " << ms << " ms";
      } else {
        ASSERT_LE(now(), named_since.at(channel) + delay) << "channel " << int{channel} << " at " << ms << " ms";
      }
    }
  }
  EXPECT_EQ(session.status().nacks, 0U);
  EXPECT_EQ(session.status().malformed_frames, 0U);
  EXPECT_EQ(session.status().reconnects, 0U);
}

TEST_F(BothEnds, FindEachOtherAgainAfterTheWatchdogHasReset) {
  run_until_armed();
  chip.hang_main_loop();
  for (int ms = 0; ms < 600; ++ms)
    run_one_ms();
  EXPECT_EQ(chip.resets(), 1U);
  EXPECT_TRUE(session.armed());
  EXPECT_EQ(session.status().reconnects, 1U);
}

}  // namespace
}  // namespace telehug
