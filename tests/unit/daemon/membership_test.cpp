// SPDX-License-Identifier: Apache-2.0
#include "daemon/membership.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "doubles/temporary_folder.hpp"
#include "pairing/wireguard.hpp"

namespace telehug {
namespace {

using testing::HasSubstr;

const WallTime now{std::chrono::seconds(1'800'000'000)};

class Memberships : public testing::Test {
 protected:
  Pair pair_with(const std::string& parents_name) {
    PairStore parent(folder / parents_name, Side::active);
    return PairStore(config.pairs_folder, Side::passive)
        .grant(parent.request(parents_name).value(), "Mia", now)
        .value()
        .pair;
  }
  [[nodiscard]] Result<Membership> member() const { return membership(config, Side::passive, now); }

  TemporaryFolder folder;
  PeerConfig config = [this] {
    PeerConfig made;
    made.pairs_folder = (folder / "pairs").string();
    made.partition = "of-the-config";
    made.addresses = "192.0.2.7";
    return made;
  }();
};

TEST_F(Memberships, WithoutAPairReachNobodyBeyondThisPc) {
  const Membership alone = member().value();
  EXPECT_FALSE(alone.pair);
  EXPECT_TRUE(alone.dds.loopback_only);
  EXPECT_TRUE(alone.dds.peers.empty());
  EXPECT_FALSE(alone.dds.security);
  EXPECT_EQ(alone.dds.partition, "of-the-config");
  EXPECT_FALSE(pair_over(alone, now + std::chrono::hours(1'000'000)));
}

TEST_F(Memberships, OfAPairUseItsFilesAndItsPartition) {
  const Pair pair = pair_with("Grandma");
  const Membership paired = member().value();
  ASSERT_TRUE(paired.pair && paired.dds.security);
  EXPECT_EQ(paired.dds.security->permissions, pair.files.permissions);
  EXPECT_EQ(paired.dds.partition, pair.partition);
  EXPECT_FALSE(paired.dds.loopback_only);
  EXPECT_EQ(paired.dds.peers, std::vector<std::string>{"192.0.2.7"});
}

TEST_F(Memberships, OfAPairTellTheForwardedPorts) {
  (void)pair_with("Grandma");
  EXPECT_FALSE(member()->dds.public_address);
  config.public_address = "198.51.100.7";
  config.public_port = 7600;
  const auto known_as = member()->dds.public_address;
  ASSERT_TRUE(known_as);
  EXPECT_EQ(known_as->address, "198.51.100.7");
  EXPECT_EQ(known_as->port, 7600);
}

TEST_F(Memberships, OfAPairWithATunnelFindThePeerInIt) {
  PairStore parent(folder / "parent", Side::active);
  const auto granted =
      PairStore(config.pairs_folder, Side::passive).grant(parent.request("Grandma").value(), "Mia", now, "home:51820");
  const std::string in_tunnel = tunnel_of(granted->pair)->peer_address;
  EXPECT_EQ(member()->dds.peers, (std::vector<std::string>{"192.0.2.7", in_tunnel}));
  config.addresses.clear();
  EXPECT_EQ(member()->dds.peers, std::vector<std::string>{in_tunnel});
  config.loopback_only = true;
  EXPECT_TRUE(member()->dds.peers.empty());
}

TEST_F(Memberships, AreAskedForIfThereAreSeveral) {
  const Pair first = pair_with("Grandma");
  const Pair second = pair_with("Dad");
  EXPECT_THAT(member().error().message, testing::AllOf(HasSubstr("peer.pair"), HasSubstr(first.id), HasSubstr("Dad")));
  config.pair = second.id;
  EXPECT_EQ(member()->pair->name, "Dad");
  config.pair = "0123456789abcdef";
  EXPECT_THAT(member().error().message, HasSubstr("is no pair of this PC"));
}

TEST_F(Memberships, OfABrokenPairAreRefusedAndNotTakenForNone) {
  const Pair pair = pair_with("Grandma");
  std::filesystem::remove(pair.files.governance);
  EXPECT_THAT(member().error().message, HasSubstr(pair.files.governance.string()));
  std::ofstream(pair.files.private_key.parent_path() / "pair.json") << "nonsense";
  EXPECT_THAT(member().error().message, HasSubstr("can't be read"));
}

TEST_F(Memberships, AreOverWhenThePairExpiresOrIsRevoked) {
  const Pair pair = pair_with("Grandma");
  const Membership paired = member().value();
  EXPECT_FALSE(pair_over(paired, pair.expires - std::chrono::seconds(1)));
  EXPECT_THAT(pair_over(paired, pair.expires).value(), HasSubstr("expired on 2028-01-15"));
  PairStore(config.pairs_folder, Side::passive).revoke(pair.id);
  EXPECT_THAT(pair_over(paired, now).value(), HasSubstr("revoked"));
}

}  // namespace
}  // namespace telehug
