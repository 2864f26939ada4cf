// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "doubles/fake_clock.hpp"
#include "peer/link_supervisor.hpp"

namespace telehug {
namespace {

struct Made {
  LinkCause cause;
  Duration at;  // since the start
};

bool operator==(const Made& a, const Made& b) {
  return a.cause == b.cause && a.at == b.at;
}

std::ostream& operator<<(std::ostream& out, const Made& made) {
  return out << sentence(made.cause) << " at " << to_ms(made.at) << " ms";
}

// A daemon's housekeeping, every 20 ms.
struct World {
  explicit World(bool network = true) : supervisor(network) {}

  void pass(Duration time) {
    for (const Timestamp end = clock.now() + time; clock.now() < end; clock.advance(20ms)) {
      if (peer_beats) supervisor.peer_heard(clock.now());
      supervisor.memory_used(memory, clock.now());
      const auto cause = supervisor.due(clock.now());
      if (!cause) continue;
      attempts.push_back({*cause, clock.now() - start});
      if (can_create) {
        supervisor.made(*cause, clock.now());
        made.push_back(attempts.back());
      } else {
        supervisor.creation_failed(clock.now());
      }
    }
  }

  void change_addresses(bool network = true) { supervisor.addresses_changed(network, clock.now()); }

  FakeClock clock;
  Timestamp start = clock.now();
  LinkSupervisor supervisor;
  bool peer_beats = false;
  bool can_create = true;
  std::uint64_t memory = 100'000'000;
  std::vector<Made> attempts;
  std::vector<Made> made;
};

using Mades = std::vector<Made>;

TEST(LinkSupervisor, MakesOneParticipantAndKeepsItWhileAllIsWell) {
  World world;
  world.peer_beats = true;
  world.pass(24h);
  EXPECT_EQ(world.made, (Mades{{LinkCause::first, 0s}}));
  EXPECT_EQ(world.supervisor.replaced(), 0U);
  EXPECT_FALSE(world.supervisor.last_cause());
}

TEST(LinkSupervisor, KeepsTheParticipantWhileThePeerWasNeverHeard) {
  World world;
  world.pass(2h);
  EXPECT_EQ(world.made.size(), 1U);
}

TEST(LinkSupervisor, ReplacesOnceTheAddressesHaveBeenQuiet) {
  World world;
  world.pass(1s);
  for (int i = 0; i < 4; ++i) {
    world.change_addresses();
    world.pass(200ms);
  }
  world.pass(10s);
  EXPECT_EQ(world.made, (Mades{{LinkCause::first, 0s}, {LinkCause::addresses_changed, 1900ms}}));
  EXPECT_EQ(world.supervisor.last_cause(), LinkCause::addresses_changed);
}

TEST(LinkSupervisor, DoesNotWaitForEverForAddressesThatNeverComeToRest) {
  World world;
  world.pass(1s);
  for (int i = 0; i < 60; ++i) {
    world.change_addresses();
    world.pass(200ms);
  }
  EXPECT_EQ(world.made.size(), 3U);
}

TEST(LinkSupervisor, WaitsForTheNetworkBeforeAnythingIsMade) {
  World world(false);
  world.pass(1h);
  EXPECT_TRUE(world.made.empty());
  world.change_addresses();
  world.pass(10s);
  EXPECT_EQ(world.made, (Mades{{LinkCause::network_came, 1h + 300ms}}));
}

TEST(LinkSupervisor, MakesNothingWhileTheNetworkIsAwayAndOneWhenItIsBackAndQuiet) {
  World world;
  world.peer_beats = true;
  world.pass(1s);
  world.peer_beats = false;
  world.change_addresses(false);
  world.pass(1h);
  EXPECT_EQ(world.made.size(), 1U);
  world.change_addresses();
  world.pass(4s);
  EXPECT_EQ(world.made, (Mades{{LinkCause::first, 0s}, {LinkCause::network_came, 1h + 1300ms}}));
}

TEST(LinkSupervisor, DefersAChangeWhileThePeerIsHeardInSpiteOfIt) {
  World world;
  world.peer_beats = true;
  world.pass(1s);
  world.change_addresses();
  world.pass(10s);
  EXPECT_EQ(world.made.size(), 1U);
  world.peer_beats = false;
  world.pass(1s);
  EXPECT_EQ(world.made.size(), 2U);
  EXPECT_EQ(world.supervisor.last_cause(), LinkCause::addresses_changed);
}

TEST(LinkSupervisor, DefersAChangeOnlyForSoLong) {
  World world;
  world.peer_beats = true;
  world.pass(1s);
  world.change_addresses();
  world.pass(40s);
  EXPECT_EQ(world.made, (Mades{{LinkCause::first, 0s}, {LinkCause::addresses_changed, 31s}}));
}

TEST(LinkSupervisor, ReplacesAfterSuspend) {
  World world;
  world.pass(1s);
  world.supervisor.resumed(world.clock.now());
  world.pass(10s);
  EXPECT_EQ(world.made, (Mades{{LinkCause::first, 0s}, {LinkCause::resumed, 1300ms}}));
}

TEST(LinkSupervisor, ReplacesAfterAHoldUpUnlessThePeerIsHeardSoon) {
  World world;
  world.peer_beats = true;
  world.pass(10s);
  world.clock.advance(12s);
  world.supervisor.held_up(world.clock.now());
  world.pass(5s);
  EXPECT_EQ(world.made.size(), 1U) << "the peer went on";
  world.clock.advance(12s);
  world.supervisor.held_up(world.clock.now());
  const Duration awake = world.clock.now() - world.start;
  world.pass(200ms);  // what had waited in a buffer
  world.peer_beats = false;
  world.pass(2s);
  ASSERT_EQ(world.made.size(), 2U);
  EXPECT_EQ(world.made[1], (Made{LinkCause::held_up, awake + 1s}));
}

TEST(LinkSupervisor, KeepsTheParticipantAfterAHoldUpWhileThePeerWasNeverHeard) {
  World world;
  world.pass(10s);
  world.supervisor.held_up(world.clock.now());
  world.pass(60s);
  EXPECT_EQ(world.made.size(), 1U);
}

TEST(LinkSupervisor, ReplacesEverMoreRarelyWhileThePeerStaysSilent) {
  World world;
  world.peer_beats = true;
  world.pass(20ms);
  world.peer_beats = false;
  world.pass(90s);
  std::vector<Duration> times;
  for (const Made& one : world.made)
    times.push_back(one.at);
  EXPECT_EQ(times, (std::vector<Duration>{0s, 4s, 12s, 28s, 58s, 88s}));
  EXPECT_EQ(world.supervisor.last_cause(), LinkCause::peer_silent);
}

TEST(LinkSupervisor, WaitsForAHandshakeThatIsUnderWay) {
  World world;
  world.peer_beats = true;
  world.pass(20ms);
  world.peer_beats = false;
  world.pass(3s);
  world.supervisor.peer_noticed(world.clock.now());
  world.pass(3s);
  EXPECT_EQ(world.made.size(), 1U);
  world.pass(2s);
  EXPECT_EQ(world.made.size(), 2U);
}

TEST(LinkSupervisor, FreesAHandshakeThatIsStuckBeforeThePeerWasEverHeard) {
  World world;
  world.pass(1s);
  world.supervisor.peer_noticed(world.clock.now());
  world.pass(6s);
  EXPECT_EQ(world.made, (Mades{{LinkCause::first, 0s}, {LinkCause::peer_silent, 5s}}));
}

// Discovery is open to everybody on the network.
TEST(LinkSupervisor, IsNotPutOffForEverByWhoeverShowsUp) {
  World world;
  world.peer_beats = true;
  world.pass(20ms);
  world.peer_beats = false;
  for (int i = 0; i < 31; ++i) {
    world.supervisor.peer_noticed(world.clock.now());
    world.pass(1s);
  }
  EXPECT_EQ(world.made.size(), 2U);
}

TEST(LinkSupervisor, IsQuickAgainOnceThePeerWasHeard) {
  World world;
  world.peer_beats = true;
  world.pass(1s);
  world.peer_beats = false;
  world.pass(1h);
  world.peer_beats = true;
  world.pass(20ms);
  world.peer_beats = false;
  const std::size_t before = world.made.size();
  world.pass(4s);
  EXPECT_EQ(world.made.size(), before + 1);
}

TEST(LinkSupervisor, TriesAgainEverMoreRarelyAfterAFailure) {
  World world;
  world.can_create = false;
  world.pass(70s);
  std::vector<Duration> times;
  for (const Made& one : world.attempts)
    times.push_back(one.at);
  EXPECT_EQ(times, (std::vector<Duration>{0s, 1s, 3s, 7s, 15s, 31s, 61s}));
  world.can_create = true;
  world.pass(30s);
  EXPECT_EQ(world.made, (Mades{{LinkCause::creation_failed, 91s}}));
}

TEST(LinkSupervisor, TriesAtOnceAfterAFailureWhenTheAddressesChange) {
  World world;
  world.can_create = false;
  world.pass(70s);
  world.can_create = true;
  world.change_addresses();
  world.pass(1s);
  EXPECT_EQ(world.made.size(), 1U);
}

TEST(LinkSupervisor, WaitsForALullWhenThePeerStartedAgainTooOften) {
  World world;
  world.peer_beats = true;
  world.pass(11min);
  for (std::uint64_t i = 0; i < LinkLimits{}.peer_restarts; ++i)
    world.supervisor.peer_restarted();
  world.pass(1h);
  EXPECT_EQ(world.made.size(), 1U);
  world.peer_beats = false;
  world.pass(1s);
  EXPECT_EQ(world.made.size(), 2U);
  EXPECT_EQ(world.supervisor.last_cause(), LinkCause::peer_restarts);
}

TEST(LinkSupervisor, ReplacesInAnyCaseWhenMemoryHasGrownTwiceTheBound) {
  World world;
  world.peer_beats = true;
  world.pass(11min);
  world.memory += 2 * LinkLimits{}.memory_growth;
  world.pass(1h);
  EXPECT_EQ(world.made.size(), 2U);
  EXPECT_EQ(world.supervisor.last_cause(), LinkCause::memory_grown);
}

TEST(LinkSupervisor, ReplacesRarelyEvenWhenMemoryGrowsWithoutEndForOtherReasons) {
  World world;
  world.peer_beats = true;
  for (int i = 0; i < 600; ++i) {
    world.memory += LinkLimits{}.memory_growth;
    world.pass(6s);
  }
  EXPECT_LE(world.made.size(), 7U);  // within an hour
}

TEST(LinkSupervisor, TakesNoGrowthAtTheStartForALeak) {
  World world;
  world.peer_beats = true;
  world.pass(30s);
  world.memory += 4 * LinkLimits{}.memory_growth;
  world.pass(2h);
  EXPECT_EQ(world.made.size(), 1U);
}

// Whatever happens: afterwards, with a network and a peer that stays silent, a replacement follows within the longest
// silence; and none once the peer is heard and what is pending is done.
TEST(LinkSupervisor, IsNeverWedgedAndNeverFlapsWhateverHappened) {
  std::mt19937 random(20261);
  const auto below = [&](unsigned end) -> unsigned { return static_cast<unsigned>(random() % end); };
  for (int run = 0; run < 400; ++run) {
    World world(below(2) == 0);
    for (unsigned step = 0, steps = 5 + below(60); step < steps; ++step) {
      switch (below(9)) {
        case 0:
          world.change_addresses(true);
          break;
        case 1:
          world.change_addresses(false);
          break;
        case 2:
          world.supervisor.resumed(world.clock.now());
          break;
        case 3:
          world.peer_beats = below(2) == 0;
          break;
        case 4:
          world.can_create = below(3) != 0;
          break;
        case 5:
          world.memory += below(2) * LinkLimits{}.memory_growth;
          break;
        case 6:
          world.supervisor.peer_restarted();
          break;
        case 7:
          world.supervisor.held_up(world.clock.now());
          break;
        default:
          break;
      }
      world.pass(below(10) == 0 ? 60s : std::chrono::milliseconds(below(3000)));
    }
    world.can_create = true;
    world.change_addresses(true);
    world.peer_beats = true;
    world.pass(1s);
    world.peer_beats = false;
    for (int i = 0; i < 4; ++i) {
      const std::size_t before = world.made.size();
      world.pass(31s);
      ASSERT_GT(world.made.size(), before) << "run " << run;
    }
    world.peer_beats = true;
    world.pass(40s);  // what was pending
    const std::size_t settled = world.made.size();
    world.pass(10min);
    ASSERT_EQ(world.made.size(), settled) << "run " << run;
    for (std::size_t i = 1; i < world.attempts.size(); ++i)
      ASSERT_GE(world.attempts[i].at - world.attempts[i - 1].at, LinkLimits{}.quiet) << "run " << run;
  }
}

}  // namespace
}  // namespace telehug
