// SPDX-License-Identifier: Apache-2.0
#include "daemon/stop_switch.hpp"

#include <gtest/gtest.h>

#include <thread>

#include "doubles/inbox.hpp"
#include "doubles/temporary_folder.hpp"
#include "doubles/unique_domain.hpp"
#include "peer/session_id.hpp"

namespace telehug {
namespace {

using nlohmann::json;

class AStop : public testing::Test {
 protected:
  TemporaryFolder folder_;
  StopSwitch stop{folder_ / "stop.json"};
};

TEST_F(AStop, StopsWhateverItsReasonIs) {
  for (const json& request : {json{{"command", "stop"}}, json{{"reason", 5}}, json{{"reason", ""}}}) {
    stop.resume();
    stop.stop(request);
    EXPECT_TRUE(stop.stopped());
    EXPECT_EQ(stop.reason(), "stopped on this side");
  }
}

TEST_F(AStop, CutsALongReasonBetweenTwoCharacters) {
  stop.stop({{"reason", std::string(199, 'x') + "\u00e4 and more"}});
  EXPECT_EQ(stop.reason(), std::string(199, 'x'));
}

TEST_F(AStop, CannotBeLiftedWhileItIsHeld) {
  stop.hold("the button was pressed", "the button is pressed");
  EXPECT_TRUE(stop.stopped());
  EXPECT_EQ(stop.reason(), "the button was pressed");
  EXPECT_EQ(stop.resume(), (json{{"error", "the button is pressed"}}));
  EXPECT_TRUE(stop.stopped());
  stop.stop({{"reason", "dinner"}});
  EXPECT_EQ(stop.resume(), (json{{"error", "the button is pressed"}})) << "another stop does not let go of it";
}

TEST_F(AStop, LastsAfterWhatHeldItHasLetGo) {
  stop.hold("the button was pressed", "the button is pressed");
  stop.release();
  EXPECT_TRUE(stop.stopped());
  EXPECT_EQ(stop.reason(), "the button was pressed");
  EXPECT_EQ(stop.resume(), (json{{"stopped", false}}));
  EXPECT_FALSE(stop.stopped());
}

class StopOverDds : public testing::Test {
 protected:
  [[nodiscard]] DdsSettings settings(Side side) const {
    return {.side = side, .domain_id = domain_.id(), .partition = domain_.partition()};
  }

  // Tells until the other side holds what is expected.
  static bool eventually(StopSwitch& stop, PeerLink& from, const PeerLink& to, bool stopped) {
    const auto give_up = std::chrono::steady_clock::now() + 10s;
    while (std::chrono::steady_clock::now() < give_up) {
      stop.tell(from);
      if (to.stopped_by_peer() == stopped) return true;
      std::this_thread::sleep_for(2ms);
    }
    return false;
  }

  TemporaryFolder folder_;
  SteadyClock clock_;
  UniqueDomain domain_;
  DdsParticipant active_{settings(Side::active)};
  DdsParticipant passive_{settings(Side::passive)};
  PeerLink to_active_{passive_, Side::passive, new_session_id(), 250ms, clock_};
};

TEST_F(StopOverDds, ReachesThePeerWithAReasonThatTheWireRefuses) {
  Inbox<StopAll> inbox;
  const Reader<StopAll> reader(passive_, inbox.callback());
  PeerLink to_passive(active_, Side::active, new_session_id(), 250ms, clock_);
  ASSERT_TRUE(to_passive.tell_stop(true, "first line\nsecond \xff line"));
  ASSERT_TRUE(inbox.wait_for(1));
  EXPECT_EQ(inbox.messages().front().reason, "first line second ? line");
}

TEST_F(StopOverDds, OutlivesItsSenderAndIsLiftedByItsNextRun) {
  StopSwitch first_run(folder_ / "stop.json");
  first_run.stop({{"reason", "enough"}});
  {
    PeerLink to_passive(active_, Side::active, new_session_id(), 250ms, clock_);
    ASSERT_TRUE(eventually(first_run, to_passive, to_active_, true));
  }
  StopSwitch second_run(folder_ / "stop.json");  // on a full disk: nothing was kept
  PeerLink to_passive(active_, Side::active, new_session_id(), 250ms, clock_);
  EXPECT_FALSE(second_run.stopped());
  EXPECT_TRUE(to_active_.stopped_by_peer());
  second_run.resume();
  EXPECT_TRUE(eventually(second_run, to_passive, to_active_, false));
}

}  // namespace
}  // namespace telehug
