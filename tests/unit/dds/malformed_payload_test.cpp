// SPDX-License-Identifier: Apache-2.0
//
// Bytes that are no message, at the type support: where the generated code lets exceptions through to Fast DDS.
#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include "dds/guarded_type.hpp"
#include "dds/wire.hpp"
#include "doubles/example_messages.hpp"

namespace telehug {
namespace {

using Payload = eprosima::fastrtps::rtps::SerializedPayload_t;
using Bytes = std::vector<unsigned char>;

template <typename T>
Bytes encoded(const T& message) {
  GuardedType<T> type;
  Sample<T> sample;
  to_wire(message, sample.wire);
  Payload payload(4096);
  EXPECT_TRUE(type.serialize(&sample, &payload));
  return {payload.data, payload.data + payload.length};
}

template <typename T>
Sample<T> decoded(const Bytes& bytes) {
  GuardedType<T> type;
  Sample<T> sample;
  Payload payload(static_cast<std::uint32_t>(bytes.size()) + 1);
  if (!bytes.empty()) std::memcpy(payload.data, bytes.data(), bytes.size());
  payload.length = static_cast<std::uint32_t>(bytes.size());
  EXPECT_TRUE(type.deserialize(&payload, &sample)) << "the reader would not get to count it";
  return sample;
}

TEST(APayload, OfAMessageIsIntact) {
  const auto sample = decoded<TouchEvent>(encoded(example_touch()));
  ASSERT_TRUE(sample.intact);
  TouchEvent event;
  EXPECT_EQ(from_wire(sample.wire, event), nullptr);
  EXPECT_EQ(event.sequence, example_touch().sequence);
}

// The encoding is what the other side's version understands: it must not change unnoticed.
TEST(APayload, HasTheBytesThatTheFuzzersCorpusKeeps) {
  const auto kept = [](const char* name) {
    std::ifstream file(std::string(TELEHUG_SOURCE "/tests/fuzz/corpus/dds/") + name, std::ios::binary);
    Bytes bytes{std::istreambuf_iterator<char>(file), {}};
    if (!bytes.empty()) bytes.erase(bytes.begin());  // chooses the topic
    return bytes;
  };
  EXPECT_EQ(encoded(example_touch()), kept("touch"));
  EXPECT_EQ(encoded(example_felt()), kept("felt"));
  EXPECT_EQ(encoded(example_heartbeat()), kept("heartbeat"));
  EXPECT_EQ(encoded(example_status()), kept("status"));
  EXPECT_EQ(encoded(example_stop()), kept("stop"));
  EXPECT_EQ(encoded(example_renewal()), kept("renewal"));
  EXPECT_EQ(encoded(example_hug()), kept("hug"));
}

TEST(APayload, ThatEndsTooEarlyIsNotIntact) {
  const Bytes whole = encoded(example_touch());
  for (std::size_t size = 0; size < whole.size(); ++size) {
    EXPECT_FALSE(decoded<TouchEvent>(Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size))).intact)
        << size << " of " << whole.size() << " bytes";
  }
}

TEST(APayload, WithAWrongHeaderIsNotIntact) {
  Bytes bytes = encoded(example_touch());
  bytes[0] = 0x77;
  EXPECT_FALSE(decoded<TouchEvent>(bytes).intact);
}

TEST(APayload, WithAHugeSequenceLengthIsNotIntactAndAllocatesLittle) {
  Bytes bytes = encoded(example_touch());
  // header 4, session 16, four numbers: 8 + 8 + 8 + 4
  const std::size_t contacts_length = 4 + 16 + 28;
  ASSERT_EQ(bytes[contacts_length], example_touch().contacts.size());
  std::memset(bytes.data() + contacts_length, 0xFF, 4);
  const auto sample = decoded<TouchEvent>(bytes);
  EXPECT_FALSE(sample.intact);
  EXPECT_LT(sample.wire.contacts().capacity(), 1000U);
}

template <typename T>
void feed_any_bytes(const T& example, unsigned seed) {
  std::mt19937 random(seed);
  const Bytes whole = encoded(example);
  T message;
  int valid = 0;
  for (int i = 0; i < 20'000; ++i) {
    Bytes bytes = whole;
    if (i % 2 == 0) {  // a few bytes of a right one changed, or nothing but noise
      for (unsigned change = random() % 4; change <= 4; ++change) {
        bytes[random() % bytes.size()] = static_cast<unsigned char>(random());
      }
    } else {
      bytes.resize(random() % 700);
      for (auto& byte : bytes)
        byte = static_cast<unsigned char>(random());
    }
    const auto sample = decoded<T>(bytes);
    if (sample.intact && from_wire(sample.wire, message) == nullptr) {
      ++valid;
      EXPECT_EQ(validate(message), nullptr);
    }
  }
  EXPECT_LT(valid, 20'000);
}

TEST(APayload, OfAnyBytesHarmsNothing) {
  feed_any_bytes(example_touch(), 1);
  feed_any_bytes(example_felt(), 2);
  feed_any_bytes(example_heartbeat(), 3);
  feed_any_bytes(example_status(), 4);
  feed_any_bytes(example_stop(), 5);
  feed_any_bytes(example_renewal(), 6);
  feed_any_bytes(example_hug(), 7);
}

}  // namespace
}  // namespace telehug
