// SPDX-License-Identifier: Apache-2.0
//
// What the firmware answers, and what it does about bytes that are no frames.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "unit/firmware/virtual_jacket.hpp"

namespace telehug {
namespace {

using protocol::FrameType;
using protocol::NackReason;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr std::uint8_t full = 255;

std::uint8_t number(FrameType type) {
  return static_cast<std::uint8_t>(type);
}
std::uint8_t number(NackReason reason) {
  return static_cast<std::uint8_t>(reason);
}

void expect_nack(const std::optional<Frame>& answer, FrameType type, NackReason reason) {
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->type, FrameType::nack);
  EXPECT_THAT(answer->payload, ElementsAre(number(type), number(reason)));
}

TEST(FirmwareConversation, AnswersAHelloWithItsCapabilities) {
  VirtualJacket jacket;
  const auto answer = jacket.hello();
  ASSERT_TRUE(answer);
  const auto caps = parse_caps(*answer);
  ASSERT_TRUE(caps);
  EXPECT_EQ(caps->protocol, 1);
  EXPECT_EQ(caps->motors, 16);
  EXPECT_EQ(caps->heaters, 0);
  EXPECT_EQ(caps->keepalive_10ms, 50);
  EXPECT_EQ(caps->drive_max_10ms, 25);
  EXPECT_EQ(caps->nonce, 0x1234);
  EXPECT_EQ(answer->sequence, jacket.sequence);
  EXPECT_TRUE(jacket.chip.armed_led());
}

TEST(FirmwareConversation, RefusesAHostOfAnotherVersionAndStaysUnarmed) {
  VirtualJacket jacket;
  expect_nack(jacket.ask(FrameType::hello, {2, 9, 0, 0}), FrameType::hello, NackReason::bad_version);
  expect_nack(jacket.ask(FrameType::hello, {0, 0, 0, 0}), FrameType::hello, NackReason::bad_version);
  expect_nack(jacket.ask(FrameType::hello, {1, 1}), FrameType::hello, NackReason::bad_length);
  expect_nack(jacket.ask(FrameType::keep), FrameType::keep, NackReason::unarmed);
  EXPECT_FALSE(jacket.chip.armed_led());
}

TEST(FirmwareConversation, AcknowledgesAStopEvenUnarmed) {
  VirtualJacket jacket;
  const auto answer = jacket.ask(FrameType::stop_all);
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->type, FrameType::ack);
  EXPECT_THAT(answer->payload, ElementsAre(number(FrameType::stop_all)));
  EXPECT_FALSE(jacket.chip.armed_led());
}

TEST(FirmwareConversation, RefusesAFrameAsAWholeWhenAnyPartIsWrong) {
  VirtualJacket jacket;
  jacket.hello();
  expect_nack(jacket.ask(FrameType::set, {3, full, 9, 16, full, 9}), FrameType::set, NackReason::bad_channel);
  expect_nack(jacket.ask(FrameType::set, {3, full}), FrameType::set, NackReason::bad_length);
  expect_nack(jacket.ask(FrameType::set), FrameType::set, NackReason::bad_length);
  expect_nack(jacket.ask(FrameType::set_all, FramePayload(17, full)), FrameType::set_all, NackReason::bad_length);
  expect_nack(jacket.ask(FrameType::keep, {1}), FrameType::keep, NackReason::bad_length);
  expect_nack(jacket.ask(FrameType::status, {1}), FrameType::status, NackReason::bad_length);
  EXPECT_THAT(jacket.channels_that_rose_since(0), IsEmpty());
}

TEST(FirmwareConversation, RefusesHeatAndWhatItDoesNotKnow) {
  VirtualJacket jacket;
  jacket.hello();
  expect_nack(jacket.ask(FrameType::heat, {0, 0x90, 1, 60}), FrameType::heat, NackReason::unknown_type);
  expect_nack(jacket.ask(static_cast<FrameType>(0x7F)), static_cast<FrameType>(0x7F), NackReason::unknown_type);
}

TEST(FirmwareConversation, DoesNotProlongADriveForADuplicate) {
  VirtualJacket jacket;
  jacket.hello();
  const Frame set{FrameType::set, ++jacket.sequence, {6, full, 10}};
  const auto said = jacket.say(set);
  for (int i = 0; i < 8; ++i) {
    jacket.chip.run_ms(20);
    jacket.say(set);
  }
  jacket.chip.run_ms(100);
  EXPECT_LE(to_ms(jacket.last_high(6) - said), 101.0);
}

TEST(FirmwareConversation, CountsBadFramesAndGoesOnWithTheNextGoodOne) {
  VirtualJacket jacket;
  jacket.hello();
  const EncodedFrame good = encode({FrameType::set, 100, {6, full, 10}});
  const std::span<const std::uint8_t> good_bytes(good.data(), good.size());

  EncodedFrame flipped = good;
  flipped[4] ^= 0x10;
  jacket.say_bytes({flipped.data(), flipped.size()});  // bad CRC

  jacket.say_bytes(good_bytes.first(5));  // truncated, then its end
  const std::vector<std::uint8_t> end{0};
  jacket.say_bytes(end);

  std::vector<std::uint8_t> oversize(300, 0x55);
  oversize.push_back(0);
  jacket.say_bytes(oversize);

  const std::vector<std::uint8_t> bad_cobs{0x40, 0x01, 0x02, 0x00};
  jacket.say_bytes(bad_cobs);

  jacket.chip.run_ms(20);
  EXPECT_THAT(jacket.channels_that_rose_since(0), IsEmpty());
  EXPECT_EQ(jacket.telemetry().frames_malformed, 4);

  jacket.say_bytes(good_bytes);
  jacket.chip.run_ms(5);
  EXPECT_THAT(jacket.channels_that_rose_since(0), ElementsAre(6));
}

TEST(FirmwareConversation, TakesNoFrameThatIsOneByteTooLong) {
  VirtualJacket jacket;
  EncodedFrame longest = encode({FrameType::keep, 1, FramePayload(protocol::payload_max_bytes, 7)});
  ASSERT_EQ(longest.size(), protocol::encoded_max_bytes);
  jacket.say_bytes({longest.data(), longest.size()});
  (void)jacket.hear(20);
  EXPECT_EQ(jacket.telemetry().frames_malformed, 0);
  longest.back() = 7;  // instead of the delimiter
  jacket.say_bytes({longest.data(), longest.size()});
  const std::vector<std::uint8_t> end{0};
  jacket.say_bytes(end);
  (void)jacket.hear(20);
  EXPECT_EQ(jacket.telemetry().frames_malformed, 1);
}

TEST(FirmwareConversation, IsMovedByNoGarbageAndStillHearsAHelloAfterIt) {
  VirtualJacket jacket;
  jacket.hello();
  std::mt19937 random(20);
  std::uniform_int_distribution<int> byte(0, 255);
  for (int i = 0; i < 20; ++i) {
    std::vector<std::uint8_t> garbage(500);
    std::ranges::generate(garbage, [&] { return static_cast<std::uint8_t>(byte(random)); });
    jacket.say_bytes(garbage);
  }
  EXPECT_THAT(jacket.channels_that_rose_since(0), IsEmpty());
  const std::vector<std::uint8_t> end{0};
  jacket.say_bytes(end);
  const auto answer = jacket.hello();
  ASSERT_TRUE(answer);
  EXPECT_TRUE(parse_caps(*answer));
}

TEST(FirmwareConversation, TellsItsTelemetryArmedOrNot) {
  VirtualJacket jacket;
  EXPECT_EQ(jacket.telemetry().armed, 0);
  jacket.hello();
  jacket.say(FrameType::set, {0, full, 20, 15, 10, 20});
  jacket.chip.run_ms(5);
  const auto telemetry = jacket.telemetry();
  EXPECT_EQ(telemetry.armed, 1);
  EXPECT_EQ(telemetry.running, 0x8001);
  EXPECT_EQ(telemetry.frames_ok, 4);
  EXPECT_EQ(telemetry.frames_malformed, 0);
}

TEST(FirmwareConversation, KeepsUpWithALineThatIsNeverIdle) {
  VirtualJacket jacket;
  jacket.hello();
  constexpr int frames = 300;
  std::vector<std::uint8_t> line;
  for (int i = 0; i < frames; ++i) {
    FramePayload payload;
    for (std::uint8_t channel = 0; channel < 16; ++channel) {
      for (const std::uint8_t value : {channel, full, std::uint8_t{25}})
        payload.push_back(value);
    }
    const EncodedFrame frame = encode({FrameType::set, ++jacket.sequence, payload});
    line.insert(line.end(), frame.begin(), frame.end());
  }
  jacket.say_bytes(line);
  int acknowledged = 0;
  for (const Frame& frame : jacket.hear(50))
    acknowledged += frame.type == FrameType::ack ? 1 : 0;
  EXPECT_EQ(acknowledged, frames);
  EXPECT_EQ(jacket.chip.uart_overruns(), 0U);
  const auto telemetry = jacket.telemetry();
  EXPECT_EQ(telemetry.bytes_overrun, 0);
  EXPECT_EQ(telemetry.frames_malformed, 0);
}

TEST(FirmwareConversation, IsResetByTheWatchdogWhenItHangsAndSaysSo) {
  VirtualJacket jacket;
  jacket.hello();
  jacket.chip.run_ms(10);
  jacket.chip.hang_main_loop();
  jacket.chip.run_ms(200);
  EXPECT_EQ(jacket.chip.resets(), 1U);
  EXPECT_FALSE(jacket.chip.armed_led());
  expect_nack(jacket.ask(FrameType::keep), FrameType::keep, NackReason::unarmed);
  const auto caps = parse_caps(jacket.hello().value());
  ASSERT_TRUE(caps);
  EXPECT_EQ(caps->reset_cause, 0x08);
}

TEST(FirmwareConversation, IsResetByTheWatchdogWhenOnlyItsTimerStops) {
  VirtualJacket jacket;
  jacket.hello();
  jacket.say(FrameType::set, {4, full, 25});
  jacket.chip.run_ms(10);
  jacket.chip.stop_timer();
  for (int i = 0; i < 20; ++i) {
    jacket.say(FrameType::keep);  // keeps the main loop awake
    jacket.chip.run_ms(10);
  }
  EXPECT_EQ(jacket.chip.resets(), 1U);
  EXPECT_FALSE(jacket.anything_high());
  EXPECT_FALSE(jacket.chip.armed_led());
}

TEST(FirmwareConversation, DoesNotResetWhileItWorks) {
  VirtualJacket jacket;
  jacket.hello();
  jacket.run_kept_alive_ms(2000);
  EXPECT_EQ(jacket.chip.resets(), 0U);
}

TEST(FirmwareConversation, IsCutOffByAMutedInput) {
  VirtualJacket jacket;
  jacket.hello();
  jacket.chip.mute_input(true);
  EXPECT_FALSE(jacket.ask(FrameType::keep));
  jacket.chip.mute_input(false);
  EXPECT_TRUE(jacket.ask(FrameType::keep));
}

}  // namespace
}  // namespace telehug
