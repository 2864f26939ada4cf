// SPDX-License-Identifier: Apache-2.0
#include "dds/message_filter.hpp"

#include <gtest/gtest.h>

#include <algorithm>
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

constexpr std::uint8_t payload_only = 5;  // little-endian, D

// DATA from a writer for a reader.
Bytes data(const Bytes& reader, const Bytes& writer, const Bytes& payload, std::uint8_t flags = payload_only) {
  Bytes whole = submessage(0x15, joined({{0, 0, 16, 0}, reader, writer, Bytes(8), payload}));
  whole[1] = flags;
  return whole;
}

Bytes message(const std::vector<Bytes>& submessages) {
  return joined({Bytes(20, 0xaa), joined(submessages)});
}
bool passes(const std::vector<Bytes>& submessages) {
  return may_pass(message(submessages));
}

Bytes number(std::uint32_t value) {
  return {static_cast<std::uint8_t>(value), static_cast<std::uint8_t>(value >> 8U),
          static_cast<std::uint8_t>(value >> 16U), static_cast<std::uint8_t>(value >> 24U)};
}
Bytes text() {
  return joined({number(4), {'a', 'b', 'c', 0}});
}
Bytes parameter(std::uint16_t id, const Bytes& value) {
  return joined(
      {{static_cast<std::uint8_t>(id), static_cast<std::uint8_t>(id >> 8U), static_cast<std::uint8_t>(value.size()), 0},
       value});
}
// A token with as many properties, of text and of octets, as it says, or not.
Bytes token(std::uint32_t properties = 1, std::uint32_t binary_properties = 1) {
  return joined({text(), number(properties), text(), text(), number(binary_properties), text(), text()});
}
const Bytes sentinel{1, 0, 0, 0};
const Bytes of_itself(12, 0xaa);
Bytes announcement(const Bytes& of = of_itself, const Bytes& more = parameter(0x1001, token())) {
  return joined({{0, 3, 0, 0}, parameter(0x50, joined({of, Bytes(4)})), more, sentinel});
}
Bytes handshake(std::uint32_t tokens = 1, const Bytes& first = token()) {
  return joined({{0, 1, 0, 0}, Bytes(96), text(), number(tokens), first});
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
  EXPECT_TRUE(passes({time, data(anybody, participants_writer, announcement())}));
  EXPECT_TRUE(
      passes({destination, data({0, 1, 0, 0xc7}, participants_writer, announcement()), submessage(0x80, Bytes(8))}));
  EXPECT_TRUE(passes({destination, data({0, 2, 1, 0xc4}, handshakes_writer, handshake())}));
}

TEST(TheFilter, LetsThroughKeysThatAreEncrypted) {
  EXPECT_TRUE(passes({destination, prefix, body, postfix, destination, prefix, body, postfix}));
}

TEST(TheFilter, RefusesPlainData) {
  EXPECT_FALSE(passes({data(anybody, touch_writer, Bytes(8))}));
  EXPECT_FALSE(passes({data(touch_reader, touch_writer, Bytes(8))}));
  EXPECT_FALSE(passes({data({0xff, 2, 2, 0xc4}, keys_writer, Bytes(8))}));
  EXPECT_FALSE(
      passes({time, data(anybody, participants_writer, announcement()), data(anybody, touch_writer, Bytes(8))}));
  // In the name of a writer that may, for a reader that may not.
  EXPECT_FALSE(passes({data(touch_reader, participants_writer, announcement())}));
}

TEST(TheFilter, RefusesWhatElseSteersReadersAndWriters) {
  for (const std::uint8_t kind : Bytes{0x06, 0x07, 0x08, 0x0c, 0x0d, 0x0f, 0x12, 0x13, 0x16, 0x02})
    EXPECT_FALSE(passes({submessage(kind, Bytes(28))})) << int{kind};
}

TEST(TheFilter, RefusesPlainDataBehindOrWithinWhatIsEncrypted) {
  EXPECT_FALSE(passes({prefix, body, postfix, data(anybody, touch_writer, Bytes(8))}));
  EXPECT_FALSE(passes({prefix, data(anybody, touch_writer, Bytes(8)), postfix}));
  EXPECT_FALSE(passes({prefix, body}));
  EXPECT_FALSE(passes({submessage(0x31, Bytes(24)), body, postfix}));
  EXPECT_FALSE(passes({body, postfix}));
}

TEST(TheFilter, RefusesLengthsThatMeanUntilTheEndOrBeyondIt) {
  Bytes until_the_end = data(anybody, participants_writer, announcement());
  until_the_end[2] = 0;
  EXPECT_FALSE(passes({until_the_end}));
  Bytes beyond = data(anybody, participants_writer, announcement());
  beyond[3] = 1;
  EXPECT_FALSE(passes({beyond}));
  EXPECT_FALSE(passes({{0x80, 1, 0, 0}, data(anybody, touch_writer, Bytes(8))}));
  EXPECT_TRUE(
      passes({{0x09, 3, 0, 0}, data(anybody, participants_writer, announcement())}));  // "no time" has no length
}

TEST(TheFilter, RefusesWhatIsNoMessage) {
  EXPECT_FALSE(may_pass({}));
  for (std::size_t size = 0; size <= 23; ++size)
    EXPECT_FALSE(may_pass(Bytes(size, 0x15))) << size;
}

TEST(TheFilter, FindsTheDataBehindQualityOfService) {
  const auto with = [](const Bytes& qos, const Bytes& more) {
    return passes({data(anybody, participants_writer, joined({qos, announcement(of_itself, more)}), payload_only | 2)});
  };
  const Bytes qos = joined({parameter(0x800f, Bytes(24)), sentinel});
  EXPECT_TRUE(with(qos, parameter(0x1001, token())));
  EXPECT_FALSE(with(qos, parameter(0x1001, token(0x40000000))));
  EXPECT_FALSE(with(parameter(0x800f, Bytes(24)), parameter(0x1001, token(0x40000000))));
  Bytes qos_later = data(anybody, participants_writer, announcement());
  qos_later[4 + 2] = 20;
  EXPECT_FALSE(passes({qos_later}));
}

TEST(TheFilter, LetsSomebodyLeave) {
  const Bytes key = joined({{0, 3, 0, 0}, parameter(0x70, Bytes(16)), sentinel});
  const Bytes qos = joined({parameter(0x71, Bytes{0, 0, 0, 3}), sentinel});
  EXPECT_TRUE(passes({data(anybody, participants_writer, joined({qos, key}), 1 | 2 | 8)}));
}

TEST(TheFilter, RefusesCountsThatExceedWhatIsThere) {
  const auto announces = [](const Bytes& more) {
    return passes({data(anybody, participants_writer, announcement(of_itself, more))});
  };
  for (const auto id : std::initializer_list<std::uint16_t>{0x1001, 0x1002, 0x1006}) {
    EXPECT_TRUE(announces(parameter(id, token())));
    EXPECT_FALSE(announces(parameter(id, token(2))));
    EXPECT_FALSE(announces(parameter(id, token(1, 0x40000000))));
    EXPECT_FALSE(announces(parameter(id, token(0xffffffff))));
  }
  EXPECT_TRUE(announces(parameter(0x59, joined({number(1), text(), text()}))));
  EXPECT_FALSE(announces(parameter(0x59, joined({number(0x10000000), text(), text()}))));
  EXPECT_TRUE(announces(parameter(0x1234, number(0xffffffff))));  // of no count
  const auto shakes = [](const Bytes& payload) { return passes({data(anybody, handshakes_writer, payload)}); };
  EXPECT_TRUE(shakes(handshake()));
  EXPECT_FALSE(shakes(handshake(2)));
  EXPECT_FALSE(shakes(handshake(0x20000000)));
  EXPECT_FALSE(shakes(handshake(1, token(3))));
}

TEST(TheFilter, RefusesAnnouncementsThatEndTooEarly) {
  const Bytes whole = announcement();
  for (std::size_t size = 0; size < whole.size() - 3; ++size)
    EXPECT_FALSE(passes(
        {data(anybody, participants_writer, Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)))}))
        << size;
  Bytes unknown_form = announcement();
  unknown_form[1] = 1;
  EXPECT_FALSE(passes({data(anybody, participants_writer, unknown_form)}));
}

TEST(TheFilter, ReadsBigEndianPayloadsAsWell) {
  const Bytes guid = joined({{0, 0x50, 0, 16}, of_itself, Bytes(4)});
  const Bytes end{0, 1, 0, 0};
  const Bytes two{0x10, 0x01, 0, 12, 0, 0, 0, 0, 0, 0, 0, 2, 0, 0, 0, 0};
  const Bytes none{0x10, 0x01, 0, 12, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0};
  EXPECT_TRUE(passes({data(anybody, participants_writer, joined({{0, 2, 0, 0}, guid, none, end}))}));
  EXPECT_FALSE(passes({data(anybody, participants_writer, joined({{0, 2, 0, 0}, guid, two, end}))}));
}

}  // namespace
}  // namespace telehug
