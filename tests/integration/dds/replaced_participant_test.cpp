// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <atomic>
#include <functional>
#include <optional>
#include <thread>

#include "doubles/unique_domain.hpp"
#include "peer/session_id.hpp"
#include "peer_link/peer_link.hpp"

namespace telehug {
namespace {

// A side as a daemon has it: a pipeline that serves without end, and the test as its housekeeping.
class RunningSide {
 public:
  RunningSide(Side side, const UniqueDomain& domain)
      : settings_{.side = side, .domain_id = domain.id(), .partition = domain.partition()},
        participant_(std::in_place, settings_),
        link(*participant_, side, session, 250ms, clock_),
        pipeline_([this] {
          while (!ending_) {
            link.serve(clock_.now());
            alive = link.alive(clock_.now());
            losses = link.state(clock_.now()).losses;
            ++rounds;
            std::this_thread::sleep_for(1ms);
          }
        }) {}
  ~RunningSide() {
    ending_ = true;
    pipeline_.join();
    link.disconnect();
  }
  RunningSide(const RunningSide&) = delete;
  RunningSide& operator=(const RunningSide&) = delete;

  void leave() {
    link.disconnect();
    participant_.reset();
  }
  void join() { link.connect(participant_.emplace(settings_)); }
  void replace() {
    leave();
    join();
  }

  const SessionId session = new_session_id();
  std::atomic<bool> alive = false;
  std::atomic<std::uint64_t> losses = 0;
  std::atomic<std::uint64_t> rounds = 0;

 private:
  SteadyClock clock_;
  DdsSettings settings_;
  std::optional<DdsParticipant> participant_;

 public:
  PeerLink link;

 private:
  std::atomic<bool> ending_ = false;
  std::thread pipeline_;
};

bool within(Duration longest, const std::function<bool()>& holds) {
  for (const auto give_up = SteadyClock().now() + longest; SteadyClock().now() < give_up;) {
    if (holds()) return true;
    std::this_thread::sleep_for(2ms);
  }
  return holds();
}

class AReplacedParticipant : public testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(both_are_heard()); }
  [[nodiscard]] bool both_are_heard() {
    return within(3s, [this] { return active_.alive && passive_.alive; });
  }

  // Gone until both have noticed, so that what is heard afterwards is heard by the new one.
  void replace_unheard(RunningSide& side) {
    side.leave();
    ASSERT_TRUE(within(3s, [this] { return !active_.alive && !passive_.alive; }));
    side.join();
  }

  UniqueDomain domain_;
  RunningSide active_{Side::active, domain_};
  RunningSide passive_{Side::passive, domain_};
};

TEST_F(AReplacedParticipant, IsHeardAndHearsAgainWithinThreeSeconds) {
  for (RunningSide* side : {&active_, &passive_}) {
    replace_unheard(*side);
    EXPECT_TRUE(both_are_heard());
  }
}

TEST_F(AReplacedParticipant, LeavesStopsLatchedOnBothSides) {
  ASSERT_TRUE(active_.link.tell_stop(true, "the parent"));
  ASSERT_TRUE(passive_.link.tell_stop(true, "the child"));
  const auto both_stopped = [this] { return active_.link.stopped_by_peer() && passive_.link.stopped_by_peer(); };
  ASSERT_TRUE(within(3s, both_stopped));
  for (RunningSide* side : {&active_, &passive_}) {
    replace_unheard(*side);
    EXPECT_TRUE(both_stopped());
    ASSERT_TRUE(both_are_heard());
    EXPECT_TRUE(both_stopped());
  }
  ASSERT_TRUE(active_.link.tell_stop(false, ""));
  EXPECT_TRUE(within(3s, [this] { return !passive_.link.stopped_by_peer(); })) << "a resume still lifts it";
}

TEST_F(AReplacedParticipant, TellsItsStopToAPeerThatMissedIt) {
  passive_.leave();
  ASSERT_TRUE(active_.link.tell_stop(true, "nobody hears it"));
  active_.replace();
  passive_.join();
  EXPECT_TRUE(within(3s, [this] { return passive_.link.stopped_by_peer(); }));
}

TEST_F(AReplacedParticipant, TellsItsStatusAgain) {
  SideStatus status;
  status.session = active_.session;
  status.side = Side::active;
  status.ready = true;
  status.version = "1";
  const auto arrives = [&] {
    return within(3s, [&] {
      active_.link.tell(status);
      return passive_.link.take_peer_status().has_value();
    });
  };
  ASSERT_TRUE(arrives());
  active_.replace();
  EXPECT_TRUE(arrives());
}

TEST_F(AReplacedParticipant, KeepsThePipelineGoingWhileThereIsNone) {
  active_.leave();
  EXPECT_FALSE(active_.link.tell_stop(true, "it can't leave now"));
  const std::uint64_t before = active_.rounds;
  EXPECT_TRUE(within(3s, [&] { return active_.rounds > before + 50; }));
  EXPECT_EQ(active_.link.dropped(), 0U);
  active_.join();
  EXPECT_TRUE(both_are_heard());
}

TEST_F(AReplacedParticipant, IsReplacedTwentyTimesInARowWithoutHarm) {
  for (int i = 0; i < 20; ++i)
    (i % 2 == 0 ? active_ : passive_).replace();
  ASSERT_TRUE(within(3s, [this] { return active_.alive && passive_.alive; }));
}

}  // namespace
}  // namespace telehug
