// SPDX-License-Identifier: Apache-2.0
//
// The host's session and the real firmware on a wire that damages what it carries, in both directions, in virtual time.
#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <iostream>
#include <random>
#include <vector>

#include "link/jacket_session.hpp"
#include "simulator/simulated_jacket.hpp"

namespace telehug {
namespace {

using Bytes = std::vector<std::uint8_t>;
using Damage = std::function<Bytes(Bytes)>;

// What a wire does to the pieces that are put on it; the pieces from the host are whole frames.
class Faults {
 public:
  explicit Faults(unsigned seed) : random_(seed) {}

  // Bytes that become others.
  Bytes wrong_bytes(Bytes bytes, double share) {
    for (std::uint8_t& byte : bytes)
      if (happens(share)) byte = static_cast<std::uint8_t>(byte + 1 + below(255));
    return bytes;
  }
  Bytes garbage_before(Bytes bytes) {
    Bytes noise(below(40));
    for (std::uint8_t& byte : noise)
      byte = static_cast<std::uint8_t>(below(256));
    bytes.insert(bytes.begin(), noise.begin(), noise.end());
    return bytes;
  }
  Bytes truncated(Bytes bytes) {
    bytes.resize(below(static_cast<unsigned>(bytes.size())));
    return bytes;
  }
  Bytes duplicated(Bytes bytes) {
    const Bytes again = bytes;
    bytes.insert(bytes.end(), again.begin(), again.end());
    return bytes;
  }
  // After the next one.
  Bytes late(Bytes bytes) {
    std::swap(bytes, kept_);
    return bytes;
  }
  Bytes with_kept(Bytes bytes) {
    bytes.insert(bytes.end(), kept_.begin(), kept_.end());
    kept_.clear();
    return bytes;
  }
  Bytes oversize_before(Bytes bytes) {
    Bytes longer(150, 0x41);
    longer.insert(longer.end(), bytes.begin(), bytes.end());
    return longer;
  }
  bool happens(double share) { return std::uniform_real_distribution<double>(0, 1)(random_) < share; }
  unsigned below(unsigned bound) {
    return bound == 0 ? 0 : std::uniform_int_distribution<unsigned>(0, bound - 1)(random_);
  }

 private:
  std::mt19937 random_;
  Bytes kept_;
};

// Both ends, a sender who asks for this and that on the first eight channels, and an eye on all pins.
class WireFaults : public ::testing::Test {
 protected:
  WireFaults() {
    chip.on_edge([this](const PinEdge& edge) {
      moved.at(edge.channel) = true;
      if (edge.high) rose.at(edge.channel) = true;
    });
    chip.run_ms(5);
    session.connected(now());
  }

  [[nodiscard]] Timestamp now() const {
    return from_ns(1'000'000'000 + static_cast<std::int64_t>(chip.cycle() * 125 / 2));
  }

  void carry() {
    for (;;) {
      const EncodedFrame frame = session.next_frame(now(), chip.bytes_in_flight() > 64);
      if (frame.empty()) break;
      chip.write(to_jacket({frame.begin(), frame.end()}));
    }
    moved = {};
    chip.run_ms(1);
    if (const Bytes heard = chip.take_output(); !heard.empty()) session.receive(to_host(heard), now());
  }

  // Whether it was at any time of the last millisecond, which is a period of the PWM.
  [[nodiscard]] bool was_high(std::uint8_t channel) const { return chip.is_high(channel) || moved.at(channel); }

  // As the safety stage: a state every 50 ms and whenever something changes, here at random.
  void ask(Faults& sender) {
    const bool changes = sender.happens(0.02);
    if (changes) {
      state.clear();
      for (std::uint8_t channel = 0; channel < used_channels; ++channel)
        if (sender.happens(0.3)) state.push_back({channel, 255, drive});
    }
    if (!changes && now() < next_renewal) return;
    next_renewal = now() + 50ms;
    const bool taken = session.send(state, now());
    for (Timestamp& end : drive_end)
      end = std::min(end, now());
    for (const MotorCommand& command : state)
      if (taken) drive_end.at(command.channel) = now() + command.duration;
  }

  void watch() {
    for (std::uint8_t channel = 0; channel < jacket_channels; ++channel) {
      if (!was_high(channel)) continue;
      ++ms_high;
      longest_after_end = std::max(longest_after_end, now() - drive_end.at(channel));
    }
  }

  void live(Duration duration, Faults& sender) {
    for (const Timestamp end = now() + duration; now() < end;) {
      ask(sender);
      carry();
      watch();
      ms_armed += session.armed() ? 1 : 0;
      ++ms_lived;
    }
  }

  // Every drive has ended by itself, and no channel has ever been high that nobody asked for.
  void expect_safe() {
    EXPECT_LE(longest_after_end, 250ms);
    for (std::size_t channel = used_channels; channel < jacket_channels; ++channel)
      EXPECT_FALSE(rose.at(channel)) << "channel " << channel;
    EXPECT_GT(ms_high, ms_lived / 4) << "the motors did run";
  }

  // With a wire that is well again everything works as before.
  void expect_recovery() {
    to_jacket = to_host = [](Bytes bytes) { return bytes; };
    const Timestamp mended = now();
    while (!(session.armed() && chip.armed_led()) && now() < mended + 3s)
      carry();
    recovery = now() - mended;
    EXPECT_TRUE(session.armed() && chip.armed_led());
    rose = {};
    session.send({{5, 255, 200ms}}, now());
    for (int ms = 0; ms < 50; ++ms)
      carry();
    EXPECT_TRUE(was_high(5));
    session.stop_all();
    for (int ms = 0; ms < 30; ++ms)
      carry();
    EXPECT_FALSE(was_high(5));
  }

  void report(const char* fault) const {
    std::cout << fault << ": pins off " << to_ms(longest_after_end)
              << " ms after their drive's end at the latest, armed " << 100 * ms_armed / ms_lived
              << " % of the time, well again after " << to_ms(recovery) << " ms, " << session.status().malformed_frames
              << " frames damaged to the host\n";
  }

  static constexpr std::uint8_t used_channels = 8;
  static constexpr Duration drive = 150ms;

  SimulatedJacket chip{TELEHUG_FIRMWARE_ELF};
  JacketSession session;
  Damage to_jacket = [](Bytes bytes) { return bytes; };
  Damage to_host = to_jacket;
  MotorCommands state;
  Timestamp next_renewal;
  std::array<Timestamp, jacket_channels> drive_end{};
  std::array<bool, jacket_channels> rose{};
  std::array<bool, jacket_channels> moved{};
  Duration longest_after_end = Duration::min();
  Duration recovery{};
  int ms_high = 0;
  int ms_armed = 0;
  int ms_lived = 0;
};

TEST_F(WireFaults, OfOneByteInAHundredBothWaysForAMinuteEndEveryDriveInTime) {
  Faults there(1);
  Faults back(2);
  Faults sender(3);
  to_jacket = [&](Bytes bytes) { return there.wrong_bytes(std::move(bytes), 0.01); };
  to_host = [&](Bytes bytes) { return back.wrong_bytes(std::move(bytes), 0.01); };
  live(60s, sender);
  expect_safe();
  EXPECT_GT(ms_armed, ms_lived * 95 / 100);
  EXPECT_GT(session.status().malformed_frames, 50U);
  EXPECT_GT(session.status().telemetry.value().frames_malformed, 50U);
  expect_recovery();
  report("1 % of bytes wrong both ways, 60 s");
}

TEST_F(WireFaults, OfOneByteInAHundredLetStopsThrough) {
  Faults there(4);
  Faults back(5);
  Faults sender(6);
  to_jacket = [&](Bytes bytes) { return there.wrong_bytes(std::move(bytes), 0.01); };
  to_host = [&](Bytes bytes) { return back.wrong_bytes(std::move(bytes), 0.01); };
  for (int stops = 0; stops < 20; ++stops) {
    live(1s, sender);
    session.stop_all();
    for (int ms = 0; ms < 300; ++ms)
      carry();
    for (std::uint8_t channel = 0; channel < jacket_channels; ++channel)
      EXPECT_FALSE(was_high(channel));
  }
}

// One of the others, on one piece in five.
class FrameFaults : public WireFaults, public ::testing::WithParamInterface<const char*> {
 protected:
  Bytes hurt(Faults& faults, Bytes bytes) const {
    const std::string_view fault = GetParam();
    if (!faults.happens(0.2)) return faults.with_kept(std::move(bytes));
    if (fault == "garbage") return faults.garbage_before(std::move(bytes));
    if (fault == "truncated") return faults.truncated(std::move(bytes));
    if (fault == "duplicated") return faults.duplicated(std::move(bytes));
    if (fault == "reordered") return faults.late(std::move(bytes));
    if (fault == "oversize") return faults.oversize_before(std::move(bytes));
    return {};  // lost
  }
};

TEST_P(FrameFaults, EndEveryDriveInTimeAndLeaveNothingBehind) {
  Faults there(7);
  Faults back(8);
  Faults sender(9);
  to_jacket = [&](Bytes bytes) { return hurt(there, std::move(bytes)); };
  to_host = [&](Bytes bytes) { return hurt(back, std::move(bytes)); };
  live(20s, sender);
  expect_safe();
  expect_recovery();
  report(GetParam());
}

INSTANTIATE_TEST_SUITE_P(Of, FrameFaults,
                         ::testing::Values("garbage", "truncated", "duplicated", "reordered", "oversize", "lost"),
                         [](const auto& given) { return std::string(given.param); });

TEST_F(WireFaults, InTheMiddleOfAFrameLeaveNothingOfItBehind) {
  for (int ms = 0; ms < 300; ++ms)
    carry();
  ASSERT_TRUE(session.armed());
  // The cable is pulled while a frame leaves.
  ASSERT_TRUE(session.send({{9, 255, 200ms}, {10, 255, 200ms}}, now()));
  const EncodedFrame frame = session.next_frame(now(), false);
  ASSERT_EQ(frame.size(), 12U);
  // All but its last byte, the delimiter, would be the whole of it: the next connection's first byte is one.
  const std::size_t parts = frame.size() - 2;
  for (std::size_t half = 1; half <= parts; ++half) {
    chip.write({frame.data(), half});
    chip.run_ms(20);
    (void)chip.take_output();
    session.disconnected();
    session.connected(now());
    for (int ms = 0; ms < 60; ++ms)
      carry();
    EXPECT_TRUE(session.armed()) << "after " << half << " bytes";
  }
  EXPECT_FALSE(rose.at(9) || rose.at(10));
  for (int ms = 0; ms < 1000; ++ms)
    carry();
  EXPECT_EQ(session.status().telemetry.value().frames_malformed, parts);
}

TEST_F(WireFaults, OfASilentWireTurnEverythingOff) {
  for (int ms = 0; ms < 100; ++ms)
    carry();
  ASSERT_TRUE(session.send({{5, 255, 250ms}}, now()));
  for (int ms = 0; ms < 50; ++ms)
    carry();
  ASSERT_TRUE(was_high(5));
  const Timestamp cut = now();
  to_jacket = [](Bytes) { return Bytes(); };
  while (was_high(5) && now() < cut + 1s) {
    session.send({{5, 255, 250ms}}, now());
    carry();
  }
  EXPECT_LE(now() - cut, 250ms);
  while (chip.armed_led() && now() < cut + 2s)
    carry();
  EXPECT_LE(now() - cut, 700ms) << "500 ms of silence and the keep that was due";
  expect_recovery();
  std::cout << "input cut: well again after " << to_ms(recovery) << " ms\n";
}

}  // namespace
}  // namespace telehug
