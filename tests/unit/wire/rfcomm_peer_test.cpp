// SPDX-License-Identifier: Apache-2.0
#include "common/rfcomm_peer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>

#include <bit>
#include <cerrno>
#include <cstring>

#include "wire/rfcomm_socket.hpp"

namespace telehug {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(RfcommPeer, IsAnAddressWithOrWithoutAChannel) {
  const auto peer = parse_rfcomm_peer("00:1a:7D:Da:71:13");
  ASSERT_TRUE(peer);
  EXPECT_THAT(peer->address, ElementsAre(0x00, 0x1A, 0x7D, 0xDA, 0x71, 0x13));
  EXPECT_EQ(peer->channel, std::nullopt);
  EXPECT_EQ(address_text(*peer), "00:1A:7D:DA:71:13");
  EXPECT_EQ(parse_rfcomm_peer("00:1A:7D:DA:71:13/1")->channel, 1);
  EXPECT_EQ(parse_rfcomm_peer("00:1A:7D:DA:71:13/30")->channel, 30);
}

TEST(RfcommPeer, IsNothingElse) {
  for (const char* wrong :
       {"", "00", "00:1A:7D:DA:71", "00:1A:7D:DA:71:1", "00:1A:7D:DA:71:13:", "00:1A:7D:DA:71:13/",
        "00:1A:7D:DA:71:13/0", "00:1A:7D:DA:71:13/31", "00:1A:7D:DA:71:13/-1", "00:1A:7D:DA:71:13/1 ",
        "00:1A:7D:DA:71:13/99999999999", "00-1A-7D-DA-71-13", "0G:1A:7D:DA:71:13", "00:1A:7D:DA:71:-1",
        "001A:7D:DA:71:130", " 00:1A:7D:DA:71:13", "+1:1A:7D:DA:71:13", "00:1A:7D:DA:71:131"})
    EXPECT_FALSE(parse_rfcomm_peer(wrong)) << wrong;
}

TEST(RfcommAddress, HoldsTheBytesInTheKernelsOrder) {
  const auto bytes = std::bit_cast<std::array<std::uint8_t, sizeof(RfcommAddress)>>(
      rfcomm_address(*parse_rfcomm_peer("00:1A:7D:DA:71:13"), 5));
  const auto family = std::bit_cast<std::array<std::uint8_t, 2>>(std::uint16_t{AF_BLUETOOTH});
  EXPECT_THAT(std::vector(bytes.begin(), bytes.begin() + 9),
              ElementsAre(family[0], family[1], 0x13, 0x71, 0xDA, 0x7D, 0x1A, 0x00, 5));
  EXPECT_EQ(sizeof(RfcommAddress), 10U) << "sockaddr_rc ends with a byte of padding";
}

TEST(RfcommTrouble, SaysWhatToDoAboutEveryReasonThatBluetoothHas) {
  const RfcommPeer peer = *parse_rfcomm_peer("00:1A:7D:DA:71:13");
  const auto sentence = [&](int error) { return rfcomm_trouble(peer, 3, error); };
  EXPECT_THAT(sentence(EAFNOSUPPORT), HasSubstr("can't connect to 00:1A:7D:DA:71:13 by Bluetooth"));
  EXPECT_THAT(sentence(EAFNOSUPPORT), HasSubstr("modprobe rfcomm"));
  EXPECT_THAT(sentence(EHOSTUNREACH), HasSubstr("bluetoothctl power on"));
  for (const int error : {EHOSTDOWN, ETIMEDOUT})
    EXPECT_THAT(sentence(error), HasSubstr("off or out of reach"));
  EXPECT_THAT(sentence(ECONNREFUSED), HasSubstr("nothing on channel 3"));
  for (const int error : {EACCES, EPERM, EBADE})
    EXPECT_THAT(sentence(error), HasSubstr("`pair 00:1A:7D:DA:71:13`"));
  EXPECT_THAT(sentence(EBUSY), HasSubstr("another program"));
  EXPECT_THAT(sentence(ECONNABORTED), HasSubstr("switch the jacket off and on"));
}

}  // namespace
}  // namespace telehug
