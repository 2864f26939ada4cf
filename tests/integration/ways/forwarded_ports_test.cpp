// SPDX-License-Identifier: Apache-2.0
//
// Two homes of which routers hide the PCs, and forward two UDP ports to them: peer.public_address, peer.public_port.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <memory>
#include <optional>
#include <system_error>

#include "dds/participant.hpp"
#include "integration/app/running_pair.hpp"
#include "netlab/hidden_pc.hpp"

namespace telehug {
namespace {

constexpr std::uint16_t port = 7600;
// A pair in one network takes about 1 s.
constexpr Duration no_longer_hoped_for = 6s;

class ForwardedPorts : public testing::Test {
 protected:
  void SetUp() override {
    try {
      homes = std::make_unique<TwoHomes>(20261129);
    } catch (const std::system_error& error) {
      GTEST_SKIP() << "network namespaces are not permitted here: " << error.what();
    }
    pair.loopback_only = false;
    pair.pair_up();
    pair.start_jacket();
    pair.calibrate("replay:" TELEHUG_FIXTURES "/rig2");
  }
  void start_passive(const NetNamespace& network) {
    const InsideNamespace inside(network);
    pair.start_passive();
  }
  void start_active(const NetNamespace& network) {
    const InsideNamespace inside(network);
    pair.start_active();
  }

  static std::string known_as(Home home) { return "peer.public_address=" + TwoHomes::address(home); }
  static std::string addresses(Home home) {
    return "peer.addresses=" + TwoHomes::address(home) + ":" + std::to_string(port);
  }
  const std::string public_port = "peer.public_port=" + std::to_string(port);

  std::unique_ptr<TwoHomes> homes;
  RunningPair pair;
};

TEST_F(ForwardedPorts, LetTouchesReachAPcBehindARouter) {
  const HiddenPc childs(*homes, Home::child);
  childs.forward(port, port + 1);
  pair.passive_settings = {known_as(Home::child), public_port};
  pair.active_settings = {addresses(Home::child)};
  start_passive(childs.network());
  start_active(homes->network(Home::parent));
  EXPECT_TRUE(eventually([&] { return pair.felt(); })) << pair.logs();
}

TEST_F(ForwardedPorts, LetTouchesReachAPcBehindARouterFromBehindAnother) {
  const HiddenPc childs(*homes, Home::child);
  const HiddenPc parents(*homes, Home::parent);
  childs.forward(port, port + 1);
  parents.forward(port, port + 1);
  pair.passive_settings = {known_as(Home::child), public_port};
  pair.active_settings = {known_as(Home::parent), public_port, addresses(Home::child)};
  start_passive(childs.network());
  start_active(parents.network());
  EXPECT_TRUE(eventually([&] { return pair.felt(); })) << pair.logs();
}

TEST_F(ForwardedPorts, AreOfNoUseUnlessTheyAreTold) {
  const HiddenPc childs(*homes, Home::child);
  // Where the domain has its ports by itself.
  const auto own = static_cast<std::uint16_t>(7410 + 250 * pair.domain());
  childs.forward(own, own + 1);
  pair.active_settings = {"peer.addresses=" + TwoHomes::address(Home::child)};
  start_passive(childs.network());
  start_active(homes->network(Home::parent));
  EXPECT_FALSE(eventually([&] { return pair.felt(); }, no_longer_hoped_for)) << pair.logs();
}

// Two forwarded ports on one side are not enough: Fast DDS answers to where the other side says that it is.
TEST_F(ForwardedPorts, OnOneSideDoNotHelpIfAnotherRouterHidesTheOtherSide) {
  const HiddenPc childs(*homes, Home::child);
  const HiddenPc parents(*homes, Home::parent);
  childs.forward(port, port + 1);
  pair.passive_settings = {known_as(Home::child), public_port};
  pair.active_settings = {addresses(Home::child)};
  start_passive(childs.network());
  start_active(parents.network());
  EXPECT_FALSE(eventually([&] { return pair.felt(); }, no_longer_hoped_for)) << pair.logs();
}

// Otherwise DDS takes the next free ones, and nobody knows why nothing arrives.
TEST_F(ForwardedPorts, ThatAnotherProgramHasAreNamed) {
  const InsideNamespace inside(homes->network(Home::child));
  const DdsSettings settings{.side = Side::passive,
                             .domain_id = pair.domain(),
                             .loopback_only = false,
                             .public_address = PublicAddress{TwoHomes::address(Home::child), port}};
  const int other = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  ASSERT_GE(other, 0);
  sockaddr_in second{};
  second.sin_family = AF_INET;
  second.sin_port = htons(port + 1);
  ASSERT_EQ(bind(other, reinterpret_cast<const sockaddr*>(&second), sizeof second), 0);
  EXPECT_THAT([&] { const DdsParticipant participant(settings); },
              testing::ThrowsMessage<DdsError>(testing::HasSubstr("UDP port 7601")));
  close(other);
  EXPECT_NO_THROW(const DdsParticipant participant(settings));
  EXPECT_NO_THROW(const DdsParticipant participant(settings));
}

// As when the parent visits: one network, and an address that does not lead there from within.
TEST_F(ForwardedPorts, DoNotKeepPcsOfOneNetworkFromFindingEachOther) {
  pair.passive_settings = {"peer.public_address=198.51.100.7", public_port};
  start_passive(homes->network(Home::child));
  start_active(homes->network(Home::parent));
  EXPECT_TRUE(eventually([&] { return pair.felt(); })) << pair.logs();
}

}  // namespace
}  // namespace telehug
