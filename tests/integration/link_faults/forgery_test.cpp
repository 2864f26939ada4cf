// SPDX-License-Identifier: Apache-2.0
//
// Packets that an outsider makes in the paired sender's name, without any key: everything that they need beyond that,
// who is who and which of its writers is which, goes over the network in the clear or can be guessed. Fast DDS 2.9
// takes messages that are not encrypted in spite of rtps_protection_kind ENCRYPT; what keeps them out is
// dds/message_filter.
#include <fastcdr/Cdr.h>
#include <gtest/gtest.h>
#include <telehug.h>

#include <algorithm>
#include <array>
#include <memory>
#include <system_error>

#include "dds/wire.hpp"
#include "doubles/child_program.hpp"
#include "doubles/example_messages.hpp"
#include "integration/link_faults/faulty_link.hpp"

namespace telehug {
namespace {

using Prefix = std::array<std::uint8_t, 12>;

// Of the purpose-made sender: numbered as they are made, 2: a writer of a type with a key.
constexpr std::array<std::uint8_t, 4> heartbeat_writer{0, 0, 1, 2};
constexpr std::array<std::uint8_t, 4> touch_writer{0, 0, 4, 2};

template <typename Wire>
Bytes encoded(const Wire& wire) {
  using eprosima::fastcdr::Cdr;
  std::array<char, 4096> memory{};
  eprosima::fastcdr::FastBuffer buffer(memory.data(), memory.size());
  Cdr cdr(buffer, Cdr::LITTLE_ENDIANNESS, Cdr::DDS_CDR);
  cdr.serialize_encapsulation();
  wire.serialize(cdr);
  const auto size = static_cast<std::ptrdiff_t>(cdr.getSerializedDataLength());
  return {memory.begin(), memory.begin() + size};
}

// An RTPS message with one DATA for whichever reader is matched with that writer (RTPS 2.3, 9.4.5.3).
Bytes forged(const Prefix& sender, const std::array<std::uint8_t, 4>& writer, std::uint32_t number, Bytes payload) {
  payload.resize((payload.size() + 3) / 4 * 4);
  Bytes message{'R', 'T', 'P', 'S', 2, 3, 1, 15};
  message.insert(message.end(), sender.begin(), sender.end());
  const std::size_t length = 20 + payload.size();
  const std::uint8_t data = 0x15;
  const std::uint8_t flags = 0x05;  // little-endian, with data
  message.insert(message.end(),
                 {data, flags, static_cast<std::uint8_t>(length), static_cast<std::uint8_t>(length >> 8U)});
  message.insert(message.end(), {0, 0, 16, 0, 0, 0, 0, 0});
  message.insert(message.end(), writer.begin(), writer.end());
  message.insert(message.end(), {0, 0, 0, 0});
  for (unsigned shift = 0; shift < 32; shift += 8)
    message.push_back(static_cast<std::uint8_t>(number >> shift));
  message.insert(message.end(), payload.begin(), payload.end());
  return message;
}

TEST(AnOutsider, CannotTouchInThePairedSendersName) {
  std::unique_ptr<FaultyLink> link;
  try {
    link = std::make_unique<FaultyLink>();
  } catch (const std::system_error& error) {
    GTEST_SKIP() << "network namespaces are not permitted here: " << error.what();
  }
  link->pair.start_jacket();
  link->start_passive();
  ASSERT_TRUE(eventually([&] { return link->pair.jacket_state() == "armed"; })) << link->pair.logs();
  link->homes.record(Home::parent);
  std::unique_ptr<ChildProgram> sender;
  {
    const InsideNamespace inside(link->homes.network(Home::parent));
    sender = std::make_unique<ChildProgram>(std::vector<std::string>{
        TELEHUG_PURPOSE_MADE_SENDER, "--domain", std::to_string(link->pair.domain()), "--store",
        link->pair.folder / "pairs-active", "--id", link->pair.pairs(Side::active).list().at(0).id});
  }
  ASSERT_TRUE(eventually([&] { return link->pair.felt(); })) << link->pair.logs();
  const auto packets = link->homes.take_recording(Home::parent);
  sender->end();
  ASSERT_TRUE(eventually([&] { return !link->pair.felt(); })) << link->pair.logs();

  Prefix prefix{};
  for (const CapturedPacket& packet : packets) {
    const auto content = udp_content(packet.frame);
    if (content && content->payload.size() > 20) std::copy_n(content->payload.begin() + 8, 12, prefix.begin());
  }
  Heartbeat heartbeat = example_heartbeat();
  TouchEvent touch = example_touch();
  touch.transitions.clear();
  touch.contacts.resize(1);
  const auto before = link->pair.counter(Side::passive, "events_received");
  v1::Heartbeat heartbeat_wire;
  v1::TouchEvent touch_wire;
  std::uint32_t number = 1'000'000;
  const auto end = std::chrono::steady_clock::now() + 3s;
  while (std::chrono::steady_clock::now() < end) {
    ++number;
    heartbeat.sequence = touch.sequence = number;
    heartbeat.sent_time_ns = touch.sent_time_ns = touch.frame_time_ns = to_ns(SteadyClock{}.now());
    to_wire(heartbeat, heartbeat_wire);
    to_wire(touch, touch_wire);
    for (const int above : {10, 11}) {
      const auto port = static_cast<std::uint16_t>(7400 + 250 * static_cast<int>(link->pair.domain()) + above);
      link->homes.send_datagram(Home::parent, port, forged(prefix, heartbeat_writer, number, encoded(heartbeat_wire)));
      link->homes.send_datagram(Home::parent, port, forged(prefix, touch_writer, number, encoded(touch_wire)));
    }
    std::this_thread::sleep_for(20ms);
    ASSERT_FALSE(link->pair.felt()) << "a forged touch was felt" << link->pair.logs();
  }
  EXPECT_EQ(link->pair.counter(Side::passive, "events_received"), before);
  EXPECT_FALSE(link->pair.status(Side::passive)["peer"]["connected"].get<bool>());
}

}  // namespace
}  // namespace telehug
