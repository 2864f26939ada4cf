// SPDX-License-Identifier: Apache-2.0
#include "daemon/membership.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <stdexcept>

#include "doubles/temporary_folder.hpp"
#include "pairing/wireguard.hpp"

namespace telehug {
namespace {

using testing::HasSubstr;
using testing::UnorderedElementsAre;

const WallTime now{std::chrono::seconds(1'800'000'000)};

class AMembership : public testing::Test {
 protected:
  Pair pair_with(const std::string& parents_name) {
    PairStore parent(folder / parents_name, Side::active);
    return PairStore(config.pairs_folder, Side::passive)
        .grant(parent.request(parents_name).value(), "Mia", now)
        .value()
        .pair;
  }
  [[nodiscard]] Result<Memberships> found() const { return memberships(config, Side::passive, now); }
  [[nodiscard]] Membership only() const {
    auto members = found().value().members;
    if (members.size() != 1) throw std::runtime_error("there are several");
    return members.front();
  }

  TemporaryFolder folder;
  PeerConfig config = [this] {
    PeerConfig made;
    made.pairs_folder = (folder / "pairs").string();
    made.partition = "of-the-config";
    made.addresses = "192.0.2.7";
    return made;
  }();
};

TEST_F(AMembership, WithoutAPairReachNobodyBeyondThisPc) {
  const Membership alone = only();
  EXPECT_FALSE(alone.pair);
  EXPECT_TRUE(alone.dds.loopback_only);
  EXPECT_TRUE(alone.dds.peers.empty());
  EXPECT_FALSE(alone.dds.security);
  EXPECT_EQ(alone.dds.partition, "of-the-config");
  EXPECT_FALSE(pair_over(alone, now + std::chrono::hours(1'000'000)));
}

TEST_F(AMembership, OfAPairUseItsFilesAndItsPartition) {
  const Pair pair = pair_with("Grandma");
  const Membership paired = only();
  ASSERT_TRUE(paired.pair && paired.dds.security);
  EXPECT_EQ(paired.dds.security->permissions, pair.files.permissions);
  EXPECT_EQ(paired.dds.partition, pair.partition);
  EXPECT_FALSE(paired.dds.loopback_only);
  EXPECT_EQ(paired.dds.peers, std::vector<std::string>{"192.0.2.7"});
}

TEST_F(AMembership, OfAPairTellTheForwardedPorts) {
  (void)pair_with("Grandma");
  EXPECT_FALSE(only().dds.public_address);
  config.public_address = "198.51.100.7";
  config.public_port = 7600;
  const auto known_as = only().dds.public_address;
  ASSERT_TRUE(known_as);
  EXPECT_EQ(known_as->address, "198.51.100.7");
  EXPECT_EQ(known_as->port, 7600);
}

TEST_F(AMembership, OfAPairWithATunnelFindThePeerInIt) {
  PairStore parent(folder / "parent", Side::active);
  const auto granted =
      PairStore(config.pairs_folder, Side::passive).grant(parent.request("Grandma").value(), "Mia", now, "home:51820");
  const std::string in_tunnel = tunnel_of(granted->pair)->peer_address;
  EXPECT_EQ(only().dds.peers, (std::vector<std::string>{"192.0.2.7", in_tunnel}));
  config.addresses.clear();
  EXPECT_EQ(only().dds.peers, std::vector<std::string>{in_tunnel});
  config.loopback_only = true;
  EXPECT_TRUE(only().dds.peers.empty());
}

TEST_F(AMembership, OfAWearerAreAllThatWereGrantedOrThoseThatAreNamed) {
  const Pair first = pair_with("Grandma");
  const Pair second = pair_with("Dad");
  const auto names = [&] {
    std::set<std::string> all;
    const Memberships present = found().value();
    for (const Membership& member : present.members)
      all.insert(member.pair->name);
    return all;
  };
  EXPECT_THAT(names(), UnorderedElementsAre("Grandma", "Dad"));
  config.pairs = second.id;
  EXPECT_THAT(names(), UnorderedElementsAre("Dad"));
  config.pairs = second.id + ", " + first.id;
  EXPECT_THAT(names(), UnorderedElementsAre("Grandma", "Dad"));
  config.pairs = "0123456789abcdef";
  EXPECT_THAT(found().error().message, HasSubstr("is no pair of this PC"));
}

TEST_F(AMembership, OfAParentWithSeveralAreToBeNamed) {
  config.pairs_folder = (folder / "parents").string();
  PairStore parent(config.pairs_folder, Side::active);
  for (const char* child : {"Mia", "Paul"}) {
    PairStore wearer(folder / child, Side::passive);
    ASSERT_TRUE(parent.accept(wearer.grant(parent.request("Grandma").value(), child, now).value().grant, now));
  }
  const auto of_parent = [&] { return memberships(config, Side::active, now); };
  EXPECT_THAT(of_parent().error().message,
              testing::AllOf(HasSubstr("peer.pairs"), HasSubstr("Mia"), HasSubstr("Paul")));
  config.pairs = "all";
  EXPECT_EQ(of_parent().value().members.size(), 2U);
}

TEST_F(AMembership, AreNoMoreThanADaemonServes) {
  for (std::size_t i = 0; i <= max_memberships; ++i)
    pair_with("parent" + std::to_string(i));
  EXPECT_THAT(found().error().message, HasSubstr("at most 8 pairs"));
}

TEST_F(AMembership, BehindForwardedPortsIsOnlyOne) {
  const Pair pair = pair_with("Grandma");
  pair_with("Dad");
  config.public_address = "198.51.100.7";
  config.public_port = 7600;
  EXPECT_THAT(found().error().message, HasSubstr("serve one pair"));
  config.pairs = pair.id;
  EXPECT_TRUE(only().dds.public_address);
}

TEST_F(AMembership, OfABrokenPairAreRefusedAndNotTakenForNone) {
  const Pair pair = pair_with("Grandma");
  std::filesystem::remove(pair.files.governance);
  EXPECT_THAT(found().error().message, HasSubstr(pair.files.governance.string()));
  std::ofstream(pair.files.private_key.parent_path() / "pair.json") << "nonsense";
  EXPECT_THAT(found().error().message, HasSubstr("can't be read"));
}

TEST_F(AMembership, AreNoneWhileNothingButTheDatesIsWrong) {
  const Pair pair = pair_with("Grandma");
  const auto at = [&](WallTime time) { return memberships(config, Side::passive, time); };
  for (const WallTime time : {pair.expires, now - std::chrono::hours(24 * 400)}) {
    const Memberships none = at(time).value();
    EXPECT_TRUE(none.members.empty());
    EXPECT_THAT(why_none(none), testing::AllOf(HasSubstr("Grandma"), HasSubstr("To do: ")));
  }
  std::filesystem::remove(pair.files.governance);
  EXPECT_FALSE(at(pair.expires)) << "that does not pass";
}

TEST_F(AMembership, OfABrokenPairBesideAnExpiredOneAreRefused) {
  const Pair first = pair_with("Grandma");
  const Pair second = pair_with("Dad");
  const auto aside = folder / "aside";
  for (const Pair& broken : {first, second}) {
    std::filesystem::rename(broken.files.governance, aside);
    const auto found = memberships(config, Side::passive, first.expires);
    std::filesystem::rename(aside, broken.files.governance);
    ASSERT_FALSE(found) << broken.name;
    EXPECT_THAT(found.error().message, testing::AllOf(HasSubstr("Grandma"), HasSubstr("Dad")));
  }
}

TEST_F(AMembership, LeaveOutABrokenPairIfAnotherCanBeUsed) {
  const Pair pair = pair_with("Grandma");
  pair_with("Dad");
  std::filesystem::remove(pair.files.governance);
  const Memberships usable = found().value();
  ASSERT_EQ(usable.members.size(), 1U);
  EXPECT_EQ(usable.members[0].pair->name, "Dad");
  ASSERT_EQ(usable.left_out.size(), 1U);
  EXPECT_THAT(usable.left_out[0], HasSubstr(pair.files.governance.string()));
}

TEST_F(AMembership, AreOverWhenThePairExpiresOrIsRevoked) {
  const Pair pair = pair_with("Grandma");
  const Membership paired = only();
  EXPECT_FALSE(pair_over(paired, pair.expires - std::chrono::seconds(1)));
  EXPECT_THAT(pair_over(paired, pair.expires).value(), HasSubstr("expired on 2028-01-15"));
  PairStore(config.pairs_folder, Side::passive).revoke(pair.id);
  EXPECT_THAT(pair_over(paired, now).value(), HasSubstr("revoked"));
}

TEST_F(AMembership, GoesOnWhenThePairWasRenewedMeanwhile) {
  constexpr auto day = std::chrono::hours(24);
  const Pair pair = pair_with("Grandma");
  const Membership paired = only();
  EXPECT_FALSE(pair_end_problem(*paired.pair, pair.expires - 15 * day));
  EXPECT_THAT(pair_end_problem(*paired.pair, pair.expires - 13 * day)->dump(),
              testing::AllOf(HasSubstr("Grandma ends on 2028-01-15"), HasSubstr("pair renew " + pair.id)));
  ASSERT_TRUE(PairStore(config.pairs_folder, Side::passive).renew(pair, pair.expires - 10 * day));
  EXPECT_FALSE(pair_end_problem(*paired.pair, pair.expires - 13 * day));
  EXPECT_EQ(pair_json(*paired.pair)["expires"], "2029-01-04");
  EXPECT_FALSE(pair_over(paired, pair.expires + 300 * day));
  EXPECT_THAT(pair_over(paired, pair.expires + 400 * day).value(), HasSubstr("expired on 2029-01-04"));
}

}  // namespace
}  // namespace telehug
