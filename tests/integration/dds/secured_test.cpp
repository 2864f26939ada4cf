// SPDX-License-Identifier: Apache-2.0
//
// A pair's files as Fast DDS sees them, and what strangers meet.
#include <gtest/gtest.h>

#include <thread>

#include "dds/participant.hpp"
#include "dds/reader.hpp"
#include "dds/writer.hpp"
#include "doubles/example_messages.hpp"
#include "doubles/inbox.hpp"
#include "doubles/temporary_folder.hpp"
#include "doubles/unique_domain.hpp"
#include "pairing/pairing.hpp"

namespace telehug {
namespace {

class Secured : public testing::Test {
 protected:
  Pair pair_up(const std::string& parents, const std::string& wearers, WallTime when = wall_time()) {
    PairStore parent(folder / parents, Side::active);
    PairStore wearer(folder / wearers, Side::passive);
    const auto granted = wearer.grant(parent.request("Grandma").value(), "Mia", when).value();
    wearers_pair = granted.pair;
    return parent.accept(granted.grant, when).value();
  }

  [[nodiscard]] DdsSettings settings(const Pair& pair) const {
    return {.side = pair.side, .domain_id = domain.id(), .partition = pair.partition, .security = pair.files};
  }

  // Says a touch again and again until it is heard; false after `patience`.
  static bool heard(Writer<TouchEvent>& writer, Inbox<TouchEvent>& inbox, Duration patience) {
    TouchEvent event = example_touch();
    const auto give_up = std::chrono::steady_clock::now() + patience;
    while (std::chrono::steady_clock::now() < give_up) {
      ++event.sequence;
      (void)writer.write(event);
      if (inbox.wait_for(1, 20ms)) return true;
    }
    return false;
  }

  // The stranger is not heard although the pair's own sender is, who came after it.
  void expect_unheard(const DdsSettings& strangers) {
    DdsParticipant stranger(strangers);
    Writer<TouchEvent> strange(stranger);
    DdsParticipant passive(settings(wearers_pair));
    Inbox<TouchEvent> inbox;
    const Reader<TouchEvent> reader(passive, inbox.callback());
    EXPECT_FALSE(heard(strange, inbox, 2500ms));
    EXPECT_EQ(strange.matched(), 0);
    DdsParticipant active(settings(parents_pair));
    Writer<TouchEvent> own(active);
    EXPECT_TRUE(heard(own, inbox, 10s));
  }

  TemporaryFolder folder;
  UniqueDomain domain;
  Pair wearers_pair;
  Pair parents_pair{pair_up("parent", "wearer")};
};

TEST_F(Secured, PairExchangesTouchesAndWhatWasFelt) {
  DdsParticipant active(settings(parents_pair));
  DdsParticipant passive(settings(wearers_pair));
  Inbox<TouchEvent> touches;
  Inbox<Felt> felt;
  const Reader<TouchEvent> touch_reader(passive, touches.callback());
  const Reader<Felt> felt_reader(active, felt.callback());
  Writer<TouchEvent> touch_writer(active);
  Writer<Felt> felt_writer(passive);
  ASSERT_TRUE(heard(touch_writer, touches, 10s));
  const auto give_up = std::chrono::steady_clock::now() + 10s;
  while (felt_writer.matched() == 0 && std::chrono::steady_clock::now() < give_up)
    std::this_thread::sleep_for(2ms);
  ASSERT_TRUE(felt_writer.write(example_felt()));
  EXPECT_TRUE(felt.wait_for(1));
}

TEST_F(Secured, PairDoesNotHearSomebodyWithoutACertificate) {
  DdsSettings plain = settings(parents_pair);
  plain.security.reset();
  expect_unheard(plain);
}

TEST_F(Secured, PairDoesNotHearAnotherWearersPairInItsPartition) {
  const Pair own = wearers_pair;
  Pair strange = pair_up("strange-parent", "strange-wearer");
  wearers_pair = own;
  // Even if its own authority permits it this partition: the permissions are another authority's.
  expect_unheard(settings(strange));
}

TEST_F(Secured, PairDoesNotHearAnotherPairOfTheSameWearer) {
  const Pair own = wearers_pair;
  const Pair fathers = pair_up("father", "wearer");
  wearers_pair = own;
  expect_unheard(settings(fathers));
}

// A client that has its own checks taken out: Fast DDS would let it into any partition if the authorities were the
// same.
TEST_F(Secured, PairDoesNotHearAnotherPairOfTheSameWearerInItsPartition) {
  const Pair own = wearers_pair;
  Pair fathers = pair_up("father", "wearer");
  wearers_pair = own;
  DdsSettings posing = settings(fathers);
  posing.security->permissions_ca = parents_pair.files.permissions_ca;
  posing.security->permissions = parents_pair.files.permissions;
  posing.security->governance = parents_pair.files.governance;
  posing.partition = own.partition;
  // Neither the father's identity with the mother's permissions comes up, nor is it heard.
  EXPECT_THROW(DdsParticipant participant(posing), DdsError);
}

TEST_F(Secured, SideMayNotWriteWhereItIsNotPermitted) {
  // The parent's files in the wearer's place: felt is not the parent's to write.
  DdsSettings posing = settings(parents_pair);
  posing.side = Side::passive;
  DdsParticipant participant(posing);
  EXPECT_THROW(Writer<Felt> writer(participant), DdsError);
  // Nor anything in another partition.
  DdsSettings elsewhere = settings(parents_pair);
  elsewhere.partition = "telehug-0123456789abcdef";
  DdsParticipant outside(elsewhere);
  EXPECT_THROW(Writer<TouchEvent> writer(outside), DdsError);
}

TEST_F(Secured, SideWhosePairHasExpiredDoesNotComeUp) {
  const Pair expired = pair_up("late-parent", "late-wearer", wall_time() - std::chrono::hours(24 * 400));
  EXPECT_THROW(DdsParticipant participant(settings(expired)), DdsError);
}

TEST_F(Secured, SideWithFilesOfTwoWearersDoesNotComeUp) {
  DdsSettings mixed = settings(parents_pair);
  mixed.security->identity_ca = pair_up("other-parent", "other-wearer").files.identity_ca;
  EXPECT_THROW(DdsParticipant participant(mixed), DdsError);
}

}  // namespace
}  // namespace telehug
