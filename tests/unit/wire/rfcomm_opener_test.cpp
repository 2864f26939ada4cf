// SPDX-License-Identifier: Apache-2.0
#include "wire/rfcomm_opener.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cerrno>

#include "doubles/fake_clock.hpp"
#include "doubles/socket_pair.hpp"

namespace telehug {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

// Bluetooth whose sockets are one end of a socket pair.
class PairedSockets final : public RfcommSockets {
 public:
  int open() override {
    if (open_error != 0) return -open_error;
    ++opened;
    pair = std::make_unique<SocketPair>();
    const int given = pair->give();
    while (decides_later && ::write(given, filling.data(), filling.size()) > 0) {
    }  // not writable until the other end reads
    return given;
  }
  int connect(int, const RfcommAddress& address) override {
    connected = address;
    return connect_error != 0 ? -connect_error : decides_later ? -EINPROGRESS : 0;
  }

  int open_error = 0;
  int connect_error = 0;
  bool decides_later = false;
  int opened = 0;
  RfcommAddress connected;
  std::unique_ptr<SocketPair> pair;  // the newest

 private:
  std::vector<std::uint8_t> filling = std::vector<std::uint8_t>(4096, 0xFF);
};

class RfcommOpenerTest : public ::testing::Test {
 protected:
  auto open() { return opener.open(clock.now()); }

  FakeClock clock;
  PairedSockets sockets;
  RfcommOpener opener{*parse_rfcomm_peer("00:1A:7D:DA:71:13/3"), sockets};
};

TEST_F(RfcommOpenerTest, ConnectsToTheAddressOnTheChannel) {
  const auto wire = open();
  ASSERT_TRUE(wire && *wire);
  EXPECT_EQ(sockets.connected.channel, 3);
  EXPECT_THAT(sockets.connected.address, ElementsAre(0x13, 0x71, 0xDA, 0x7D, 0x1A, 0x00));
  EXPECT_EQ(opener.device(), "00:1A:7D:DA:71:13");
}

TEST_F(RfcommOpenerTest, WaitsForNoConnectionButAsksAgain) {
  sockets.decides_later = true;
  EXPECT_FALSE(open());
  EXPECT_THAT(opener.progress(), HasSubstr("connecting"));
  clock.advance(3s);
  EXPECT_FALSE(open());
  (void)sockets.pair->read();
  const auto wire = open();
  ASSERT_TRUE(wire && *wire);
  EXPECT_EQ(sockets.opened, 1) << "one attempt";
}

TEST_F(RfcommOpenerTest, TellsWhyAConnectionCameToNothing) {
  sockets.decides_later = true;
  EXPECT_FALSE(open());
  sockets.pair->close_own();  // with unread bytes: a reset
  const auto wire = open();
  ASSERT_TRUE(wire && !*wire);
  EXPECT_THAT(wire->error().message, HasSubstr("Connection reset by peer"));
}

TEST_F(RfcommOpenerTest, GivesUpAfterEightSecondsAndBeginsAnew) {
  sockets.decides_later = true;
  EXPECT_FALSE(open());
  clock.advance(7999ms);
  EXPECT_FALSE(open());
  clock.advance(1ms);
  const auto wire = open();
  ASSERT_TRUE(wire && !*wire);
  EXPECT_THAT(wire->error().message, HasSubstr("off or out of reach"));
  EXPECT_TRUE(sockets.pair->read().size() > 0 && sockets.pair->is_closed());
  sockets.decides_later = false;
  EXPECT_TRUE(*open());
  EXPECT_EQ(sockets.opened, 2);
}

TEST_F(RfcommOpenerTest, TellsWhatTheKernelRefusesAtOnce) {
  sockets.connect_error = ECONNREFUSED;
  EXPECT_THAT(open()->error().message, HasSubstr("nothing on channel 3"));
  EXPECT_TRUE(sockets.pair->is_closed());
  sockets.open_error = EAFNOSUPPORT;
  EXPECT_THAT(open()->error().message, HasSubstr("kernel has no Bluetooth"));
}

TEST(KernelRfcommSockets, SayThatThisKernelHasNoBluetooth) {
  const int socket = kernel_rfcomm_sockets().open();
  if (socket >= 0) {
    close(socket);
    GTEST_SKIP() << "this kernel has Bluetooth";
  }
  RfcommOpener opener(*parse_rfcomm_peer("00:1A:7D:DA:71:13/1"));
  const auto wire = opener.open({});
  ASSERT_TRUE(wire && !*wire);
  EXPECT_EQ(wire->error().message,
            "can't connect to 00:1A:7D:DA:71:13 by Bluetooth: Address family not supported by protocol: this system's "
            "kernel has no Bluetooth; load its module rfcomm (`modprobe rfcomm`), or use a cable");
}

}  // namespace
}  // namespace telehug
