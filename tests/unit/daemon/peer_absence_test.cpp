// SPDX-License-Identifier: Apache-2.0
#include "daemon/peer_absence.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "daemon/stranger_note.hpp"
#include "doubles/fake_clock.hpp"
#include "peer_link/pair_over.hpp"

namespace telehug {
namespace {

using testing::HasSubstr;

const std::optional<SideStatus> told_nothing;
const std::optional<Stranger> nobody;

TEST(AnAbsentPeer, OfAPairThatIsOverThereIsSaidToBeThat) {
  SideStatus last;
  last.reason = pair_over_reason;
  const PeerAbsence absence = peer_absence(Side::active, true, last, Stranger{"192.0.2.1", true});
  EXPECT_THAT(absence.what, HasSubstr("revoked on the other PC"));
  EXPECT_THAT(absence.to_do, HasSubstr("telehug pair"));
}

TEST(AnAbsentPeer, IsToldBesideWhoWasRefusedAndWhoRefuses) {
  EXPECT_THAT(peer_absence(Side::active, true, told_nothing, Stranger{"192.0.2.1", true}).what,
              HasSubstr("somebody at 192.0.2.1 tried to connect without belonging to this pair"));
  EXPECT_THAT(peer_absence(Side::active, true, told_nothing, Stranger{"192.0.2.1", false}).what,
              HasSubstr("the handshake with 192.0.2.1 comes to no end"));
}

TEST(AnAbsentPeer, IsLookedForOnTheOtherPcOrWithoutAPairOnThisOne) {
  EXPECT_THAT(peer_absence(Side::active, true, told_nothing, nobody).to_do, HasSubstr("start telehug-passive on the"));
  EXPECT_THAT(peer_absence(Side::passive, false, told_nothing, nobody).to_do, HasSubstr("start telehug-active here"));
}

class StrangerNoteTest : public testing::Test {
 protected:
  void look(const std::optional<Stranger>& seen, std::uint64_t refusals = 0) {
    note.look(seen, refusals, own_addresses, clock.now());
  }

  FakeClock clock;
  std::set<std::string> own_addresses{"eth0 192.0.2.7"};
  StrangerNote note;
};

TEST_F(StrangerNoteTest, OutlivesTheParticipantThatSawTheStrangerAndEndsAfterAWhile) {
  const Stranger stranger{"192.0.2.1", true};
  look(stranger, 1);
  note.participant_replaced();
  look(nobody, 0);
  EXPECT_EQ(note.stranger(), stranger);
  clock.advance(StrangerNote::remembered_for);
  look(nobody, 2);
  EXPECT_EQ(note.stranger(), nobody);
  EXPECT_EQ(note.refusals(), 3U);
}

TEST_F(StrangerNoteTest, TakesNothingOnThisPcForAStranger) {
  look(Stranger{"192.0.2.7", true});
  EXPECT_EQ(note.stranger(), nobody);
  look(Stranger{"192.0.2.77", true});
  EXPECT_NE(note.stranger(), nobody);
}

}  // namespace
}  // namespace telehug
