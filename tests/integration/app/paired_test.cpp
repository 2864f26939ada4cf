// SPDX-License-Identifier: Apache-2.0
//
// Both daemons as a pair, through DDS Security. What a stranger meets is in test_dds_secured.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iostream>
#include <iterator>

#include "integration/app/running_pair.hpp"
#include "service/exit_code.hpp"

namespace telehug {
namespace {

// The local addresses of the UDP sockets that a process has open, as in /proc/net/udp: "0100007F".
std::set<std::string> udp_addresses(pid_t pid) {
  std::set<std::string> inodes;
  const std::string process = "/proc/" + std::to_string(pid);
  for (const auto& entry : std::filesystem::directory_iterator(process + "/fd")) {
    std::error_code gone;
    const std::string target = std::filesystem::read_symlink(entry.path(), gone).string();
    if (target.starts_with("socket:[")) inodes.insert(target.substr(8, target.size() - 9));
  }
  std::set<std::string> addresses;
  std::ifstream table(process + "/net/udp");
  std::string line;
  while (std::getline(table, line)) {
    std::istringstream words(line);
    const std::vector<std::string> fields{std::istream_iterator<std::string>(words), {}};
    if (fields.size() > 9 && inodes.contains(fields[9])) addresses.insert(fields[1].substr(0, 8));
  }
  return addresses;
}

TEST(Paired, DaemonsFeelTouchesAndTellTheSamePhrase) {
  RunningPair pair;
  pair.pair_up();
  ASSERT_TRUE(pair.start_all()) << pair.logs();
  const auto active = pair.status(Side::active);
  const auto passive = pair.status(Side::passive);
  EXPECT_EQ(active["pair"]["phrase"], passive["pair"]["phrase"]);
  EXPECT_EQ(active["pair"]["name"], "Mia");
  EXPECT_EQ(passive["pair"]["name"], "Grandma");
}

TEST(Paired, ThatEndsInAWeekIsRenewedWhileItWorks) {
  RunningPair pair;
  PairStore parent = pair.pairs(Side::active);
  PairStore wearer = pair.pairs(Side::passive);
  const WallTime paired = wall_time() - std::chrono::hours(24 * 358);
  const auto granted = wearer.grant(parent.request("Grandma").value(), "Mia", paired).value();
  const Pair before = parent.accept(granted.grant, paired).value();
  ASSERT_TRUE(pair.start_all()) << pair.logs();
  EXPECT_TRUE(eventually([&] { return present(before).expires > before.expires + std::chrono::hours(24 * 300); }))
      << pair.logs();
  for (const Side side : {Side::active, Side::passive}) {
    EXPECT_EQ(pair.status(side)["pair"]["expires"], pair.status(Side::active)["pair"]["expires"]);
    EXPECT_FALSE(pair.complains(side, "ends on")) << pair.logs();
    EXPECT_EQ(pair.status(side)["link"]["replaced"], 0);
  }
  EXPECT_TRUE(pair.felt());
  // Started anew they meet with the new files.
  pair.active.reset();
  pair.passive.reset();
  pair.start_passive();
  pair.start_active();
  EXPECT_TRUE(eventually([&] { return pair.felt(); })) << pair.logs();
}

TEST(Paired, RevokingOnTheWearersPcSilencesTheJacketAtOnceAndEndsTheDaemon) {
  RunningPair pair;
  pair.pair_up();
  ASSERT_TRUE(pair.start_all()) << pair.logs();
  PairStore store = pair.pairs(Side::passive);
  const std::string id = store.list().at(0).id;
  const auto took_ms = pair.ms_to_silence([&] { store.revoke(id); });
  ASSERT_TRUE(took_ms) << pair.logs();
  std::cout << "silent after a revocation: " << *took_ms << " ms\n";
  EXPECT_LE(*took_ms, 600);
  EXPECT_TRUE(eventually([&] { return !pair.passive->runs(); })) << pair.logs();
  EXPECT_EQ(pair.passive->end(), to_int(ExitCode::pair_ended));
  EXPECT_TRUE(store.list().empty());
}

TEST(Paired, RevokingOnTheParentsPcEndsItsDaemonAndTheTouch) {
  RunningPair pair;
  pair.pair_up();
  ASSERT_TRUE(pair.start_all()) << pair.logs();
  PairStore store = pair.pairs(Side::active);
  const auto took_ms = pair.ms_to_silence([&] { store.revoke(store.list().at(0).id); });
  ASSERT_TRUE(took_ms) << pair.logs();
  EXPECT_LE(*took_ms, 600);
  EXPECT_TRUE(eventually([&] { return !pair.active->runs(); })) << pair.logs();
  EXPECT_EQ(pair.active->end(), to_int(ExitCode::pair_ended));
}

TEST(Paired, WithoutAPairNoSocketIsReachableFromTheNetworkWhateverIsConfigured) {
  RunningPair pair;
  pair.active_settings.emplace_back("peer.loopback_only=false");
  ASSERT_TRUE(pair.start_all()) << pair.logs();
  // 239.255.0.1 is where DDS discovers by multicast; the group is joined on the loopback interface alone.
  EXPECT_THAT(udp_addresses(pair.active->pid()),
              testing::AllOf(testing::Contains("0100007F"), testing::Each(testing::AnyOf("0100007F", "0100FFEF"))));
}

TEST(Paired, ADamagedPairIsNamedWithItsFileAndWhatMendsItAndTheDaemonDoesNotStart) {
  RunningPair pair;
  pair.pair_up();
  const auto files = pair.pairs(Side::passive).list().at(0).files;
  std::filesystem::resize_file(files.permissions, 100);
  const Outcome outcome = pair.run(pair.passive_command());
  EXPECT_EQ(outcome.code, to_int(ExitCode::config));
  EXPECT_NE(outcome.text.find(files.permissions.string()), std::string::npos) << outcome.text;
  EXPECT_NE(outcome.text.find("telehug pair"), std::string::npos) << outcome.text;
}

// systemd starts a daemon again after this code, not after that of a fault in the configuration.
TEST(Paired, APairThatHasExpiredEndsEitherDaemonAsOneThatEndsWhileItRuns) {
  RunningPair pair;
  pair.pair_up("", wall_time() - std::chrono::hours(24 * 800));
  for (const auto& command : {pair.passive_command(), pair.active_command()}) {
    const Outcome outcome = pair.run(command);
    EXPECT_EQ(outcome.code, to_int(ExitCode::pair_ended)) << outcome.text;
    EXPECT_NE(outcome.text.find("it has expired on 20"), std::string::npos) << outcome.text;
    EXPECT_NE(outcome.text.find("telehug pair renew"), std::string::npos) << outcome.text;
  }
}

TEST(Paired, APairThatIsNotValidYetEndsADaemonLikewiseAndAsksForTheClock) {
  RunningPair pair;
  pair.pair_up("", wall_time() + std::chrono::hours(24 * 800));
  const Outcome outcome = pair.run(pair.passive_command());
  EXPECT_EQ(outcome.code, to_int(ExitCode::pair_ended)) << outcome.text;
  EXPECT_NE(outcome.text.find("check this PC's clock"), std::string::npos) << outcome.text;
}

}  // namespace
}  // namespace telehug
