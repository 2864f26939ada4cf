// SPDX-License-Identifier: Apache-2.0
//
// Several parents touch one child, one parent touches several children, and pairs come and go while the daemons run.
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>

#include "integration/app/running_pair.hpp"

namespace telehug {
namespace {

using Json = nlohmann::json;

constexpr double silent_within_ms = 600;  // twice the limit: these are real processes beside others

void pair_up(PairStore parent, const std::string& parents_name, PairStore wearer, const std::string& wearers_name) {
  const WallTime now = wall_time();
  const auto granted = wearer.grant(parent.request(parents_name).value(), wearers_name, now);
  ASSERT_TRUE(granted) << granted.error().message;
  ASSERT_TRUE(parent.accept(granted->grant, now));
}

std::string pair_named(const PairStore& store, const std::string& name) {
  for (const Pair& pair : store.list())
    if (pair.name == name) return pair.id;
  return "";
}

// A second home whose programs speak in the first one's DDS domain.
class Neighbour : public RunningPair {
 public:
  explicit Neighbour(const RunningPair& first) : first_(first) { calibration = first.calibration; }

  void start_active() {
    active.reset();
    active = std::make_unique<ChildProcess>(in_first_domain(active_command()), folder / "active.log");
  }
  void start_passive() {
    passive.reset();
    passive = std::make_unique<ChildProcess>(in_first_domain(passive_command()), folder / "passive.log");
  }

 private:
  [[nodiscard]] std::vector<std::string> in_first_domain(std::vector<std::string> command) const {
    std::ranges::replace(command, "peer.domain=" + std::to_string(domain()),
                         "peer.domain=" + std::to_string(first_.domain()));
    return command;
  }

  const RunningPair& first_;
};

std::set<std::string> connected_peers(const Json& status) {
  std::set<std::string> names;
  if (!status.is_object() || !status.contains("peers")) return names;
  for (const Json& peer : status["peers"])
    if (peer["connected"] == true) names.insert(peer["name"].get<std::string>());
  return names;
}

class TwoParents : public testing::Test {
 protected:
  // Both rest a finger at the same place of the child's picture.
  void start() {
    pair_up(home.pairs(Side::active), "Grandma", home.pairs(Side::passive), "Mia");
    pair_up(dads.pairs(Side::active), "Dad", home.pairs(Side::passive), "Mia");
    ASSERT_TRUE(home.start_all()) << home.logs();
    dads.start_active();
    const std::set<std::string> both{"Dad", "Grandma"};
    ASSERT_TRUE(eventually([&] { return connected_peers(home.status(Side::passive)) == both; })) << home.logs();
    ASSERT_TRUE(eventually([&] { return dads.counter(Side::active, "touches_published") > 0; })) << dads.logs();
  }

  RunningPair home;
  Neighbour dads{home};
};

TEST_F(TwoParents, AreFeltTogetherAndEachForThemselves) {
  start();
  const std::size_t changes = home.pins().size();
  home.active->kill_now();
  ASSERT_TRUE(eventually([&] { return connected_peers(home.status(Side::passive)) == std::set<std::string>{"Dad"}; }))
      << home.logs();
  EXPECT_TRUE(home.felt()) << home.logs();
  EXPECT_EQ(home.pins().size(), changes) << "the touch of the other one was interrupted" << home.logs();
  const auto silent = home.ms_to_silence([&] { dads.active->kill_now(); });
  ASSERT_TRUE(silent) << home.logs();
  EXPECT_LE(*silent, silent_within_ms);
}

TEST_F(TwoParents, AreFeltOneAfterTheOtherIfThatIsConfigured) {
  home.passive_settings.emplace_back("jacket.several_senders=exclusive");
  start();
  const auto silent = home.ms_to_silence([&] { home.active->kill_now(); });
  ASSERT_TRUE(silent) << home.logs();
  EXPECT_LE(*silent, silent_within_ms);
  EXPECT_TRUE(eventually([&] { return home.felt(); })) << home.logs();
}

TEST_F(TwoParents, LoseOnlyTheOneWhosePairIsRevokedAndTheirStopStays) {
  start();
  ASSERT_EQ(dads.telehug("stop", Side::active).code, 0);
  ASSERT_TRUE(eventually([&] { return !home.felt(); })) << home.logs();
  EXPECT_TRUE(home.complains(Side::passive, "Dad has stopped everything")) << home.logs();
  PairStore store = home.pairs(Side::passive);
  ASSERT_TRUE(store.revoke(pair_named(store, "Dad")));
  ASSERT_TRUE(eventually([&] { return !home.status(Side::passive).contains("peers"); })) << home.logs();
  EXPECT_TRUE(home.complains(Side::passive, "Dad had stopped everything")) << home.logs();
  EXPECT_FALSE(home.felt()) << home.logs();
  ASSERT_EQ(home.telehug("resume", Side::passive).code, 0);
  EXPECT_TRUE(eventually([&] { return home.felt(); })) << home.logs();
  EXPECT_EQ(home.status(Side::passive)["pair"]["name"], "Grandma");
}

// They try to shake hands with each other, in vain.
TEST(TwoPairsOfOneDaemon, AreNoStrangersToEachOther) {
  RunningPair home;
  pair_up(home.pairs(Side::active), "Grandma", home.pairs(Side::passive), "Mia");
  const RunningPair dads;
  pair_up(dads.pairs(Side::active), "Dad", home.pairs(Side::passive), "Mia");
  home.start_jacket();
  home.start_passive();
  ASSERT_TRUE(eventually([&] { return home.counter(Side::passive, "peers_refused") > 0; })) << home.logs();
  EXPECT_TRUE(eventually([&] { return home.complains(Side::passive, "no peer is connected"); })) << home.logs();
  EXPECT_FALSE(home.complains(Side::passive, "tried to connect")) << home.logs();
}

TEST(TwoChildren, AreBothTouchedByOneParentAndStopForThemselves) {
  RunningPair mias;
  Neighbour pauls{mias};
  pair_up(mias.pairs(Side::active), "Grandma", mias.pairs(Side::passive), "Mia");
  pair_up(mias.pairs(Side::active), "Grandma", pauls.pairs(Side::passive), "Paul");
  EXPECT_EQ(mias.run(mias.active_command()).code, 3) << "with several it must be said who is touched";
  mias.active_settings.emplace_back("peer.pairs=all");
  pauls.start_jacket();
  pauls.start_passive();
  ASSERT_TRUE(mias.start_all()) << mias.logs();
  ASSERT_TRUE(eventually([&] { return pauls.felt(); })) << pauls.logs();
  ASSERT_EQ(mias.telehug("stop", Side::passive).code, 0);
  ASSERT_TRUE(eventually([&] { return !mias.felt(); })) << mias.logs();
  EXPECT_TRUE(eventually([&] { return mias.complains(Side::active, "Mia has stopped everything"); })) << mias.logs();
  EXPECT_TRUE(pauls.felt()) << pauls.logs();
  ASSERT_EQ(mias.telehug("stop", Side::active).code, 0);
  EXPECT_TRUE(eventually([&] { return !pauls.felt(); })) << pauls.logs();
}

TEST(ANewPair, IsTakenUpByDaemonsThatRunWithoutOne) {
  RunningPair pair;
  ASSERT_TRUE(pair.start_all()) << pair.logs();
  pair.pair_up();
  const auto paired = [&] {
    const Json status = pair.status(Side::passive);
    return status.is_object() && status.contains("pair") && status["peer"]["connected"] == true;
  };
  ASSERT_TRUE(eventually(paired)) << pair.logs();
  EXPECT_TRUE(eventually([&] { return pair.felt(); })) << pair.logs();
  EXPECT_EQ(pair.status(Side::passive)["pair"]["name"], "Grandma");
}

}  // namespace
}  // namespace telehug
