// SPDX-License-Identifier: Apache-2.0
#include "dds/message_filter.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace telehug {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes joined(const std::vector<Bytes>& parts) {
  Bytes all;
  for (const Bytes& part : parts)
    all.insert(all.end(), part.begin(), part.end());
  return all;
}

Bytes submessage(std::uint8_t kind, const Bytes& content) {
  return joined({{kind, 1, static_cast<std::uint8_t>(content.size()), 0}, content});
}

// DATA from a writer for a reader, with a payload of 8 bytes.
Bytes data(const Bytes& reader, const Bytes& writer) {
  return submessage(0x15, joined({{0, 0, 16, 0}, reader, writer, Bytes(16)}));
}

bool passes(const std::vector<Bytes>& submessages) {
  return may_pass(joined({Bytes(20, 0xaa), joined(submessages)}));
}

const Bytes anybody{0, 0, 0, 0};
const Bytes participants_writer{0, 1, 0, 0xc2};
const Bytes handshakes_writer{0, 2, 1, 0xc3};
const Bytes touch_writer{0, 0, 7, 2};
const Bytes touch_reader{0, 0, 7, 7};
const Bytes keys_writer{0xff, 2, 2, 0xc3};
const Bytes time = submessage(0x09, Bytes(8));
const Bytes destination = submessage(0x0e, Bytes(12));
const Bytes prefix = submessage(0x31, Bytes(20));
const Bytes body = submessage(0x30, Bytes(44));
const Bytes postfix = submessage(0x32, Bytes(20));

TEST(TheFilter, LetsThroughWhatIsEncryptedAsAWhole) {
  EXPECT_TRUE(passes({submessage(0x33, Bytes(20)), submessage(0x30, Bytes(40)), submessage(0x34, Bytes(20))}));
}

TEST(TheFilter, LetsThroughWhoIsThereAndTheHandshake) {
  EXPECT_TRUE(passes({time, data(anybody, participants_writer)}));
  EXPECT_TRUE(passes({destination, data({0, 1, 0, 0xc7}, participants_writer), submessage(0x80, Bytes(8))}));
  EXPECT_TRUE(passes({destination, data({0, 2, 1, 0xc4}, handshakes_writer)}));
}

TEST(TheFilter, LetsThroughKeysThatAreEncrypted) {
  EXPECT_TRUE(passes({destination, prefix, body, postfix, destination, prefix, body, postfix}));
}

TEST(TheFilter, RefusesPlainData) {
  EXPECT_FALSE(passes({data(anybody, touch_writer)}));
  EXPECT_FALSE(passes({data(touch_reader, touch_writer)}));
  EXPECT_FALSE(passes({data({0xff, 2, 2, 0xc4}, keys_writer)}));
  EXPECT_FALSE(passes({time, data(anybody, participants_writer), data(anybody, touch_writer)}));
  // In the name of a writer that may, for a reader that may not.
  EXPECT_FALSE(passes({data(touch_reader, participants_writer)}));
}

TEST(TheFilter, RefusesWhatElseSteersReadersAndWriters) {
  for (const std::uint8_t kind : Bytes{0x06, 0x07, 0x08, 0x0c, 0x0d, 0x0f, 0x12, 0x13, 0x16, 0x02})
    EXPECT_FALSE(passes({submessage(kind, Bytes(28))})) << int{kind};
}

TEST(TheFilter, RefusesPlainDataBehindOrWithinWhatIsEncrypted) {
  EXPECT_FALSE(passes({prefix, body, postfix, data(anybody, touch_writer)}));
  EXPECT_FALSE(passes({prefix, data(anybody, touch_writer), postfix}));
  EXPECT_FALSE(passes({prefix, body}));
  EXPECT_FALSE(passes({submessage(0x31, Bytes(24)), body, postfix}));
  EXPECT_FALSE(passes({body, postfix}));
}

TEST(TheFilter, RefusesLengthsThatMeanUntilTheEndOrBeyondIt) {
  Bytes until_the_end = data(anybody, participants_writer);
  until_the_end[2] = 0;
  EXPECT_FALSE(passes({until_the_end}));
  Bytes beyond = data(anybody, participants_writer);
  beyond[3] = 1;
  EXPECT_FALSE(passes({beyond}));
  EXPECT_FALSE(passes({{0x80, 1, 0, 0}, data(anybody, touch_writer)}));
  EXPECT_TRUE(passes({{0x09, 3, 0, 0}, data(anybody, participants_writer)}));  // "no time" has no length
}

TEST(TheFilter, RefusesWhatIsNoMessage) {
  EXPECT_FALSE(may_pass({}));
  for (std::size_t size = 0; size <= 23; ++size)
    EXPECT_FALSE(may_pass(Bytes(size, 0x15))) << size;
}

}  // namespace
}  // namespace telehug
