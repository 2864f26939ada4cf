// SPDX-License-Identifier: Apache-2.0
#include "link/frame_codec.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <string_view>
#include <vector>

namespace telehug {
namespace {

using protocol::FrameType;
using ::testing::ElementsAreArray;

std::vector<Frame> decode(FrameDecoder& decoder, const std::vector<std::uint8_t>& bytes) {
  std::vector<Frame> frames;
  for (const std::uint8_t byte : bytes) {
    if (auto frame = decoder.push(byte)) frames.push_back(*frame);
  }
  return frames;
}

std::vector<std::uint8_t> bytes_of(const EncodedFrame& frame) {
  return {frame.begin(), frame.end()};
}

struct Golden {
  const char* name;
  Frame frame;
  std::vector<std::uint8_t> bytes;
};

// The bytes come from an independent program (Python, binascii.crc_hqx).
const std::vector<Golden> goldens{
    {"hello", {FrameType::hello, 1, {1, 1, 0x34, 0x12}}, {0x09, 0x01, 0x01, 0x01, 0x01, 0x34, 0x12, 0x47, 0x5B, 0x00}},
    {"keep", {FrameType::keep, 2, {}}, {0x05, 0x02, 0x02, 0x2F, 0x5B, 0x00}},
    {"stop_all", {FrameType::stop_all, 3, {}}, {0x05, 0x03, 0x03, 0x3F, 0x78, 0x00}},
    {"set", {FrameType::set, 4, {3, 255, 25}}, {0x08, 0x10, 0x04, 0x03, 0xFF, 0x19, 0x10, 0x06, 0x00}},
    {"set_all",
     {FrameType::set_all, 5, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 250, 0}},
     {0x03, 0x11, 0x05, 0x11, 0x01, 0x02, 0x03, 0x04, 0x05, 0x06, 0x07, 0x08,
      0x09, 0x0A, 0x0B, 0x0C, 0x0D, 0x0E, 0x0F, 0xFA, 0x03, 0x22, 0x18, 0x00}},
    {"status", {FrameType::status, 6, {}}, {0x05, 0x12, 0x06, 0xD8, 0x18, 0x00}},
    {"heat", {FrameType::heat, 7, {0, 0x90, 1, 60}}, {0x03, 0x13, 0x07, 0x06, 0x90, 0x01, 0x3C, 0x77, 0x01, 0x00}},
    {"caps",
     {FrameType::caps, 1, {1, 1, 16, 0, 0, 32, 64, 50, 25, 8, 0x34, 0x12}},
     {0x06, 0x81, 0x01, 0x01, 0x01, 0x10, 0x01, 0x0A, 0x20, 0x40, 0x32, 0x19, 0x08, 0x34, 0x12, 0x64, 0x79, 0x00}},
    {"ack", {FrameType::ack, 4, {0x10}}, {0x06, 0x82, 0x04, 0x10, 0x53, 0x47, 0x00}},
    {"nack", {FrameType::nack, 4, {0x10, 3}}, {0x07, 0x83, 0x04, 0x10, 0x03, 0xF4, 0x2D, 0x00}},
    {"telemetry",
     {FrameType::telemetry, 6, {0x2C, 1, 2, 0, 0, 0, 1, 1, 0x08, 0x80, 0x88, 0x13}},
     {0x06, 0x92, 0x06, 0x2C, 0x01, 0x02, 0x01, 0x01, 0x09, 0x01, 0x01, 0x08, 0x80, 0x88, 0x13, 0x5E, 0xDE, 0x00}},
};

TEST(FrameCodec, HasTheCrcThatTheProtocolNames) {
  constexpr std::string_view check = "123456789";
  EXPECT_EQ(frame_crc(std::vector<std::uint8_t>(check.begin(), check.end())), 0x29B1);
}

TEST(FrameCodec, EncodesEveryTypeOfFrameToItsExactBytes) {
  for (const Golden& golden : goldens) {
    EXPECT_THAT(encode(golden.frame), ElementsAreArray(golden.bytes)) << golden.name;
  }
}

TEST(FrameCodec, DecodesEveryTypeOfFrameFromItsExactBytes) {
  for (const Golden& golden : goldens) {
    FrameDecoder decoder;
    const auto frames = decode(decoder, golden.bytes);
    ASSERT_EQ(frames.size(), 1U) << golden.name;
    EXPECT_EQ(frames[0].type, golden.frame.type) << golden.name;
    EXPECT_EQ(frames[0].sequence, golden.frame.sequence) << golden.name;
    EXPECT_THAT(frames[0].payload, ElementsAreArray(golden.frame.payload)) << golden.name;
    EXPECT_EQ(decoder.malformed(), 0U) << golden.name;
  }
}

TEST(FrameCodec, ReadsTheFieldsOfCapabilitiesAndTelemetry) {
  const auto caps = parse_caps(goldens[7].frame);
  ASSERT_TRUE(caps);
  EXPECT_EQ(caps->motors, 16);
  EXPECT_EQ(caps->encoded_max_bytes, 64);
  EXPECT_EQ(caps->reset_cause, 8);
  EXPECT_EQ(caps->nonce, 0x1234);
  const auto telemetry = parse_telemetry(goldens[10].frame);
  ASSERT_TRUE(telemetry);
  EXPECT_EQ(telemetry->frames_ok, 300);
  EXPECT_EQ(telemetry->frames_malformed, 2);
  EXPECT_EQ(telemetry->running, 0x8008);
  EXPECT_EQ(telemetry->supply_mv, 5000);
  EXPECT_FALSE(parse_caps(goldens[10].frame));
  EXPECT_FALSE(parse_telemetry({FrameType::telemetry, 0, {1, 2, 3}}));
}

TEST(FrameCodec, GivesBackEveryFrameItEncodes) {
  std::mt19937 random(1);
  std::uniform_int_distribution<int> byte(0, 255);
  std::uniform_int_distribution<std::size_t> length(0, protocol::payload_max_bytes);
  FrameDecoder decoder;
  for (int i = 0; i < 20'000; ++i) {
    Frame frame{static_cast<FrameType>(byte(random)), static_cast<std::uint8_t>(byte(random)), {}};
    frame.payload.resize(length(random));
    // Many zeros: they are what COBS is about.
    for (auto& value : frame.payload)
      value = static_cast<std::uint8_t>(byte(random) < 80 ? 0 : byte(random));
    const auto encoded = bytes_of(encode(frame));
    ASSERT_EQ(encoded.size(), frame.payload.size() + 6);
    ASSERT_EQ(std::ranges::count(encoded, 0), 1);
    const auto frames = decode(decoder, encoded);
    ASSERT_EQ(frames.size(), 1U);
    ASSERT_EQ(frames[0].type, frame.type);
    ASSERT_EQ(frames[0].sequence, frame.sequence);
    ASSERT_EQ(frames[0].payload, frame.payload);
  }
  EXPECT_EQ(decoder.malformed(), 0U);
}

TEST(FrameCodec, RefusesEveryFrameWithOneFlippedBit) {
  for (const Golden& golden : goldens) {
    for (std::size_t bit = 0; bit < 8 * (golden.bytes.size() - 1); ++bit) {
      auto damaged = golden.bytes;
      damaged[bit / 8] = static_cast<std::uint8_t>(damaged[bit / 8] ^ 1U << bit % 8);
      FrameDecoder decoder;
      EXPECT_TRUE(decode(decoder, damaged).empty()) << golden.name << " bit " << bit;
      EXPECT_GE(decoder.malformed(), 1U);
    }
  }
}

TEST(FrameCodec, FindsTheNextFrameAfterAnyGarbage) {
  std::mt19937 random(2);
  std::uniform_int_distribution<int> byte(0, 255);
  std::uniform_int_distribution<std::size_t> length(0, 300);
  FrameDecoder decoder;
  for (int i = 0; i < 2'000; ++i) {
    std::vector<std::uint8_t> stream(length(random));
    std::ranges::generate(stream, [&] { return static_cast<std::uint8_t>(byte(random)); });
    stream.push_back(0);
    const Golden& golden = goldens[static_cast<std::size_t>(i) % goldens.size()];
    stream.insert(stream.end(), golden.bytes.begin(), golden.bytes.end());
    const auto frames = decode(decoder, stream);
    ASSERT_FALSE(frames.empty());
    EXPECT_EQ(frames.back().type, golden.frame.type);
  }
}

TEST(FrameCodec, CountsAFrameThatIsTooLongOnceAndIgnoresEmptyOnes) {
  FrameDecoder decoder;
  std::vector<std::uint8_t> stream(1004, 0x11);
  std::fill(stream.end() - 4, stream.end(), std::uint8_t{0});
  EXPECT_TRUE(decode(decoder, stream).empty());
  EXPECT_EQ(decoder.malformed(), 1U);
}

}  // namespace
}  // namespace telehug
