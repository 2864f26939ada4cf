// SPDX-License-Identifier: Apache-2.0
#include "daemon/connections.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <stdexcept>

#include "doubles/fake_clock.hpp"
#include "doubles/temporary_folder.hpp"

namespace telehug {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

const WallTime now{std::chrono::seconds(1'800'000'000)};

// What Connections asks of a connection, and the number that it was given.
struct ToyConnection {
  Membership its_membership;
  std::size_t number = 0;
  [[nodiscard]] const Membership& membership() const { return its_membership; }
  [[nodiscard]] std::string name() const { return its_membership.pair ? its_membership.pair->name : "nobody"; }
};

class ConnectionsOfADaemon : public testing::Test {
 protected:
  Pair pair_with(const std::string& name) {
    PairStore parent(folder / name, Side::active);
    return PairStore(config.pairs_folder, Side::passive).grant(parent.request(name).value(), "Mia", now)->pair;
  }
  void revoke(const Pair& pair) const { PairStore(config.pairs_folder, Side::passive).revoke(pair.id); }
  void start() { connections.open(memberships(config, Side::passive, now).value().members); }
  // Housekeeping looks once a second.
  bool look() {
    clock.advance(1s);
    return connections.follow_pairs(
        now,
        [this](const ToyConnection& connection, const std::string& why) {
          EXPECT_THAT(names(), testing::Contains(connection.name()));
          ended.push_back(connection.name() + ": " + why);
        },
        [this](const ToyConnection& connection) {
          EXPECT_THAT(names(), testing::Not(testing::Contains(connection.name())));
        });
  }
  [[nodiscard]] std::vector<std::string> names() const {
    std::vector<std::string> all;
    for (const auto& connection : connections.all())
      all.push_back(connection->name());
    return all;
  }
  // What the pipeline sees.
  std::vector<std::string> adopted() {
    connections.adopt();
    std::vector<std::string> all;
    for (const auto& connection : connections.adopted())
      all.push_back(connection->name());
    return all;
  }

  TemporaryFolder folder;
  FakeClock clock;
  PeerConfig config = [this] {
    PeerConfig its;
    its.pairs_folder = (folder / "pairs").string();
    return its;
  }();
  bool can_connect = true;
  std::vector<std::weak_ptr<ToyConnection>> made;
  std::vector<std::string> ended;
  using Toys = Connections<ToyConnection>;
  Toys connections{PairsWatch(config, Side::passive, clock), [this](Membership membership, const Toys::List& others) {
                     if (!can_connect) throw std::runtime_error("no port is free");
                     std::size_t number = 0;
                     for (const auto& other : others)
                       number = std::max(number, other->number + 1);
                     auto connection = std::make_shared<ToyConnection>(std::move(membership), number);
                     made.push_back(connection);
                     return connection;
                   }};
};

TEST_F(ConnectionsOfADaemon, AreMadeKnowingThoseThatWereMadeBefore) {
  pair_with("Grandma");
  pair_with("Dad");
  start();
  ASSERT_EQ(made.size(), 2U);
  EXPECT_NE(made[0].lock()->number, made[1].lock()->number);
  EXPECT_THAT(names(), UnorderedElementsAre("Grandma", "Dad"));
}

TEST_F(ConnectionsOfADaemon, BeginWhenAPairIsMadeAndEndTheUnpairedOne) {
  start();
  EXPECT_THAT(names(), ElementsAre("nobody"));
  EXPECT_TRUE(look());
  pair_with("Grandma");
  EXPECT_TRUE(look());
  EXPECT_THAT(names(), ElementsAre("Grandma"));
  EXPECT_NE(made[1].lock()->number, 0U) << "the pipeline may still use the old one";
  pair_with("Dad");
  EXPECT_TRUE(look());
  EXPECT_THAT(names(), ElementsAre("Grandma", "Dad"));
}

TEST_F(ConnectionsOfADaemon, ThatAreMadeAtOnceKnowOfEachOther) {
  start();
  pair_with("Grandma");
  pair_with("Dad");
  EXPECT_TRUE(look());
  std::set<std::size_t> numbers;
  for (const auto& connection : connections.all())
    numbers.insert(connection->number);
  EXPECT_EQ(numbers.size(), 2U);
}

TEST_F(ConnectionsOfADaemon, EndWithTheirPairsAndAreDestroyedOnlyWhenThePipelineHasLetGo) {
  const Pair grandma = pair_with("Grandma");
  const Pair dad = pair_with("Dad");
  start();
  EXPECT_THAT(adopted(), UnorderedElementsAre("Grandma", "Dad"));
  revoke(dad);
  EXPECT_TRUE(look());
  EXPECT_THAT(ended, ElementsAre(testing::HasSubstr("Dad: the pair with Dad was revoked")));
  EXPECT_THAT(names(), ElementsAre("Grandma"));
  const auto exist = [&] { return std::ranges::count_if(made, [](const auto& one) { return !one.expired(); }); };
  EXPECT_EQ(exist(), 2);
  EXPECT_THAT(adopted(), ElementsAre("Grandma"));
  EXPECT_TRUE(look());
  EXPECT_EQ(exist(), 1);
  revoke(grandma);
  EXPECT_FALSE(look());
}

TEST_F(ConnectionsOfADaemon, AreTriedAgainWhenOneCantBeMade) {
  pair_with("Grandma");
  start();
  pair_with("Dad");
  can_connect = false;
  EXPECT_TRUE(look());
  EXPECT_THAT(names(), ElementsAre("Grandma"));
  can_connect = true;
  EXPECT_TRUE(look());
  EXPECT_THAT(names(), ElementsAre("Grandma", "Dad"));
}

TEST_F(ConnectionsOfADaemon, StayAsTheyAreWhenThePairsCantBeRead) {
  const Pair grandma = pair_with("Grandma");
  start();
  std::ofstream(grandma.files.private_key.parent_path() / "pair.json") << "nonsense";
  EXPECT_TRUE(look());
  EXPECT_THAT(names(), ElementsAre("Grandma"));
}

TEST_F(ConnectionsOfADaemon, AreAllGoneAfterClosing) {
  pair_with("Grandma");
  start();
  EXPECT_THAT(adopted(), ElementsAre("Grandma"));
  connections.close();
  EXPECT_TRUE(made[0].expired());
  EXPECT_THAT(names(), IsEmpty());
}

}  // namespace
}  // namespace telehug
