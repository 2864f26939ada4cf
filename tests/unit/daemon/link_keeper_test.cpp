// SPDX-License-Identifier: Apache-2.0
//
// With real participants, bound to loopback, and a clock that the test moves.
#include "daemon/link_keeper.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>
#include <fastdds/dds/log/Log.hpp>

#include <memory>
#include <sstream>

#include "doubles/fake_clock.hpp"
#include "doubles/unique_domain.hpp"

namespace telehug {
namespace {

class HeldUpLinkKeeper : public testing::Test {
 protected:
  // Rounds of housekeeping, half a second apart.
  void serve(int rounds, bool peer_is_heard) {
    for (int round = 0; round < rounds; ++round) {
      clock.advance(500ms);
      PeerState peer;
      peer.alive = peer_is_heard;
      keeper.serve(peer,
                   {.disconnect = [this] { ++disconnected; }, .connect = [this](DdsParticipant&) { ++connected; }});
    }
  }

  UniqueDomain domain;
  FakeClock clock;
  LinkKeeper keeper{{.domain_id = domain.id(), .partition = domain.partition(), .loopback_only = true}, clock};
  int disconnected = 0;
  int connected = 0;
};

TEST(LinkKeeperOfADaemon, TellsInItsLogWhatFastDdsWouldWriteToTheStandardError) {
  using eprosima::fastdds::dds::Log;
  const auto before = spdlog::default_logger();
  std::ostringstream told;
  spdlog::set_default_logger(
      std::make_shared<spdlog::logger>("test", std::make_shared<spdlog::sinks::ostream_sink_mt>(told)));
  testing::internal::CaptureStderr();
  {
    const UniqueDomain domain;
    const FakeClock clock;
    const LinkKeeper keeper{{.domain_id = domain.id(), .partition = domain.partition(), .loopback_only = true}, clock};
    Log::QueueLog("a storm", {"file", 1, "here", "PART"}, Log::Kind::Error);
    Log::Flush();
  }
  spdlog::set_default_logger(before);
  EXPECT_THAT(told.str(), testing::HasSubstr("Fast DDS (PART, here): a storm"));
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST_F(HeldUpLinkKeeper, MakesTheParticipantAnewWithinASecondAndAHalfWhereThePeerIsNotHeardAfterwards) {
  serve(4, true);
  clock.advance(12s);
  serve(1, true);  // by a heartbeat that has waited in a buffer
  serve(1, false);
  EXPECT_EQ(disconnected, 0);
  serve(1, false);
  EXPECT_EQ(disconnected, 1);
  EXPECT_EQ(connected, 1);
  EXPECT_EQ(keeper.status()["last_reason"], sentence(LinkCause::held_up));
}

TEST_F(HeldUpLinkKeeper, KeepsTheParticipantWhereThePeerIsHeardAsBefore) {
  serve(4, true);
  clock.advance(12s);
  serve(20, true);
  EXPECT_EQ(disconnected, 0);
}

TEST_F(HeldUpLinkKeeper, TakesAShortPauseForNothing) {
  serve(4, true);
  clock.advance(2s);
  serve(1, true);
  serve(5, false);  // less than the silence that counts without a hold-up
  EXPECT_EQ(disconnected, 0);
}

}  // namespace
}  // namespace telehug
