// SPDX-License-Identifier: Apache-2.0
//
// Bluetooth through BlueZ's D-Bus interface, on a bus of the test's own.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cerrno>
#include <thread>

#include "doubles/fake_bluez.hpp"
#include "doubles/private_bus.hpp"
#include "link/jacket_session.hpp"
#include "link/wire_link.hpp"
#include "wire/rfcomm_checks.hpp"
#include "wire/rfcomm_opener.hpp"

namespace telehug {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

// Sockets that must not be needed, or that tell on which channel they were.
class OwnSockets final : public RfcommSockets {
 public:
  int open() override {
    if (open_error != 0) return -open_error;
    pair = std::make_unique<SocketPair>();
    return pair->give();
  }
  int connect(int, const RfcommAddress& address) override {
    channel = address.channel;
    return 0;
  }
  int open_error = 0;
  int channel = 0;
  std::unique_ptr<SocketPair> pair;
};

class BluezTest : public ::testing::Test {
 protected:
  // Asks as often as a link does, until there is an answer.
  std::optional<Result<Wire>> open(RfcommOpener& asked) {
    const Timestamp give_up = SteadyClock{}.now() + 20s;
    while (SteadyClock{}.now() < give_up) {
      if (auto wire = asked.open(SteadyClock{}.now())) return wire;
      std::this_thread::sleep_for(1ms);
    }
    return std::nullopt;
  }
  std::string error(RfcommOpener& asked) {
    const auto wire = open(asked);
    return !wire ? "no answer" : *wire ? "it opens" : wire->error().message;
  }
  FakeBluez& start(FakeBluez::Script script = {}) { return bluez.emplace(bus.address(), std::move(script)); }
  std::vector<RfcommCheck> check() { return check_rfcomm(peer, sockets, bus.address()); }

  const RfcommPeer peer = *parse_rfcomm_peer("00:1A:7D:DA:71:13");
  const PrivateBus bus;
  std::optional<FakeBluez> bluez;
  OwnSockets sockets;
  RfcommOpener opener{peer, sockets, bus.address()};
};

TEST_F(BluezTest, HandsOverTheConnectionToTheSerialPort) {
  const FakeBluez& service = start();
  auto wire = open(opener);
  ASSERT_TRUE(wire && *wire) << wire->error().message;
  EXPECT_EQ(service.registered(), "/telehug/jacket 00001101-0000-1000-8000-00805f9b34fb client");
  EXPECT_EQ((*wire)->write(std::vector<std::uint8_t>{1, 2}), 2U);
  EXPECT_THAT(service.connection()->read(), ElementsAre(1, 2));
  service.connection()->write(std::vector<std::uint8_t>{3});
  std::array<std::uint8_t, 8> buffer{};
  EXPECT_EQ((*wire)->read(buffer), 1U);
  EXPECT_EQ(sockets.channel, 0) << "no other socket was needed";
}

TEST_F(BluezTest, ConnectsAgainAsOftenAsItIsAskedTo) {
  const FakeBluez& service = start();
  for (std::size_t times = 1; times <= 3; ++times) {
    auto wire = open(opener);
    ASSERT_TRUE(wire && *wire) << wire->error().message;
    EXPECT_TRUE(service.was_asked(times));
    EXPECT_EQ((*wire)->write(std::vector<std::uint8_t>{1}), 1U);
  }
}

TEST_F(BluezTest, FindsABluezThatHasBeenStartedAgain) {
  start();
  ASSERT_TRUE(*open(opener));
  bluez.reset();
  start();
  const auto wire = open(opener);
  ASSERT_TRUE(wire);
  EXPECT_TRUE(*wire) << wire->error().message;
}

// The other end is played here, frame by frame.
TEST_F(BluezTest, CarriesTheConversationWithAJacketAndBeginsItAnewAfterALoss) {
  const FakeBluez& service = start();
  WireLink link(std::make_unique<RfcommOpener>(peer, sockets, bus.address()), std::make_unique<JacketSession>());
  FrameDecoder decoder;
  const auto answer = [&](const Frame& frame) {
    Frame reply{protocol::FrameType::ack, frame.sequence, {static_cast<std::uint8_t>(frame.type)}};
    if (frame.type == protocol::FrameType::hello) {
      reply.type = protocol::FrameType::caps;
      reply.payload = {1, 1, 12, 0, 0, 32, 64, 50, 25, 1, frame.payload.at(2), frame.payload.at(3)};
    }
    const EncodedFrame bytes = encode(reply);
    service.connection()->write({bytes.data(), bytes.size()});
  };
  const auto arms = [&] {
    const Timestamp give_up = SteadyClock{}.now() + 20s;
    while (link.status().state != LinkState::armed && SteadyClock{}.now() < give_up) {
      link.poll(SteadyClock{}.now());
      if (!service.connection()) continue;
      for (const std::uint8_t byte : service.connection()->read())
        if (const auto frame = decoder.push(byte)) answer(*frame);
      std::this_thread::sleep_for(1ms);
    }
    return link.status().state == LinkState::armed;
  };
  ASSERT_TRUE(arms()) << link.status().problem;
  EXPECT_EQ(link.status().device, "00:1A:7D:DA:71:13");
  EXPECT_EQ(link.status().motor_count, 12);
  service.connection()->close_own();
  for (int last_words = 0; last_words < 2; ++last_words)
    link.poll(SteadyClock{}.now());
  EXPECT_EQ(link.status().problem,
            "the connection to 00:1A:7D:DA:71:13 is lost: switch the jacket on, or bring it nearer");
  ASSERT_TRUE(arms()) << link.status().problem;
  EXPECT_EQ(link.status().reconnects, 1U);
}

TEST_F(BluezTest, NeverMakesTheCallerWait) {
  const FakeBluez& service = start({.answers = false});
  const Timestamp begin = SteadyClock{}.now();
  EXPECT_FALSE(opener.open(begin));
  EXPECT_TRUE(service.was_asked(1)) << "BlueZ is at it and does not answer";
  for (int i = 0; i < 100; ++i)
    EXPECT_FALSE(opener.open(SteadyClock{}.now()));
  EXPECT_LT(SteadyClock{}.now() - begin, 15s) << "20 s would be waiting for BlueZ; so would the end of this";
}

TEST_F(BluezTest, TakesTheUsualChannelWhereThereIsNoBluez) {
  const auto wire = open(opener);
  ASSERT_TRUE(wire);
  EXPECT_TRUE(*wire);
  EXPECT_EQ(sockets.channel, 1);
}

TEST_F(BluezTest, TakesTheUsualChannelWhereThereIsNoBus) {
  RfcommOpener busless(peer, sockets, "unix:path=/nonexistent/bus");
  const auto wire = open(busless);
  ASSERT_TRUE(wire);
  EXPECT_TRUE(*wire);
  EXPECT_EQ(sockets.channel, 1);
}

TEST_F(BluezTest, SaysWhatIsMissing) {
  FakeBluez& service = start({.has_adapter = false});
  EXPECT_THAT(error(opener), HasSubstr("no Bluetooth adapter"));
  service.rewrite([](auto& script) { script.has_adapter = true, script.powered = false; });
  EXPECT_THAT(error(opener), HasSubstr("`bluetoothctl power on`"));
  service.rewrite([](auto& script) { script.powered = true, script.paired = false; });
  EXPECT_THAT(error(opener), HasSubstr("`pair 00:1A:7D:DA:71:13`"));
  service.rewrite([](auto& script) { script.paired = true, script.knows_device = false; });
  EXPECT_THAT(error(opener), HasSubstr("is not paired"));
  service.rewrite([](auto& script) { script.knows_device = true; });
  EXPECT_EQ(error(opener), "it opens");
}

TEST_F(BluezTest, SaysInWordsWhyBluezCannotConnect) {
  FakeBluez& service = start();
  const auto said_of = [&](const std::string& failure) {
    service.rewrite([&](auto& script) { script.connecting_fails = failure; });
    return error(opener);
  };
  EXPECT_THAT(said_of("org.bluez.Error.Failed: br-connection-page-timeout"), HasSubstr("off or out of reach"));
  EXPECT_THAT(said_of("org.bluez.Error.Failed: Host is down"), HasSubstr("off or out of reach"));
  EXPECT_THAT(said_of("org.bluez.Error.Failed: br-connection-key-missing"), HasSubstr("pair it again"));
  EXPECT_THAT(said_of("org.bluez.Error.NotAvailable: br-connection-profile-unavailable"),
              HasSubstr("offers no serial port"));
  EXPECT_THAT(said_of("org.bluez.Error.AlreadyConnected: Already Connected"), HasSubstr("another program"));
  EXPECT_THAT(said_of("org.example.Odd: \x1b[31mred"), HasSubstr("what can't be shown"));
}

TEST_F(BluezTest, SaysThatItMayNotUseBluez) {
  start({.registering_fails = "org.freedesktop.DBus.Error.AccessDenied"});
  EXPECT_THAT(error(opener), HasSubstr("group bluetooth"));
}

TEST_F(BluezTest, BelievesNoConnectionToAnotherDevice) {
  start({.wrong_device = "/org/bluez/hci0/dev_another"});
  EXPECT_THAT(error(opener), HasSubstr("rejected"));
}

TEST_F(BluezTest, SaysThatNoConnectionWasHandedOver) {
  start({.hands_over = false});
  EXPECT_THAT(error(opener), HasSubstr("handed no connection over"));
}

TEST_F(BluezTest, ChecksEverythingThatAJacketByBluetoothNeeds) {
  FakeBluez& service = start();
  auto checks = check();
  ASSERT_EQ(checks.size(), 3U);
  for (const RfcommCheck& check : checks)
    EXPECT_TRUE(check.passed) << check.sentence;
  EXPECT_THAT(checks[1].sentence, HasSubstr("00:1A:7D:DA:71:13 is paired"));
  EXPECT_EQ(checks[2].sentence, "it is not connected now");
  service.rewrite([](auto& script) { script.connected = true; });
  EXPECT_EQ(check().back().sentence, "it is connected");
}

TEST_F(BluezTest, ChecksUntilSomethingIsMissing) {
  FakeBluez& service = start({.paired = false});
  auto checks = check();
  ASSERT_EQ(checks.size(), 2U);
  EXPECT_FALSE(checks[1].passed);
  EXPECT_THAT(checks[1].sentence, HasSubstr("is not paired"));
  service.rewrite([](auto& script) { script.paired = true, script.uuids.clear(); });
  checks = check();
  ASSERT_EQ(checks.size(), 4U);
  EXPECT_FALSE(checks[2].passed);
  EXPECT_THAT(checks[2].sentence, HasSubstr("no serial port"));
  sockets.open_error = EAFNOSUPPORT;
  checks = check();
  ASSERT_EQ(checks.size(), 1U);
  EXPECT_FALSE(checks[0].passed);
  EXPECT_THAT(checks[0].sentence, HasSubstr("kernel has no Bluetooth"));
}

TEST_F(BluezTest, ChecksThatThereIsBluez) {
  const auto checks = check();
  ASSERT_EQ(checks.size(), 2U);
  EXPECT_FALSE(checks[1].passed);
  EXPECT_THAT(checks[1].sentence, HasSubstr("systemctl start bluetooth"));
}

}  // namespace
}  // namespace telehug
