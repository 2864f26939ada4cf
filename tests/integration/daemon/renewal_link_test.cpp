// SPDX-License-Identifier: Apache-2.0
//
// A pair whose certificates end in 30 days renews itself over its own link.
#include "daemon/renewal_link.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <thread>

#include "dds/dds_error.hpp"
#include "doubles/example_messages.hpp"
#include "doubles/inbox.hpp"
#include "doubles/temporary_folder.hpp"
#include "doubles/unique_domain.hpp"

namespace telehug {
namespace {

constexpr auto day = std::chrono::hours(24);

std::string content(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

class APairThatEndsSoon : public testing::Test {
 protected:
  APairThatEndsSoon() {
    const WallTime paired = wall_time() - 335 * day;
    const auto granted = wearer.grant(parent.request("Grandma").value(), "Mia", paired).value();
    wearers = granted.pair;
    parents = parent.accept(granted.grant, paired).value();
  }

  [[nodiscard]] DdsSettings settings(const Pair& pair) const {
    return {.side = pair.side, .domain_id = domain.id(), .partition = pair.partition, .security = pair.files};
  }

  // Serves both ends, as housekeeping does, until the parent's PC has a pair that lives longer; false after 10 s.
  [[nodiscard]] bool renewed(RenewalSender& sender, RenewalReceiver& receiver) const {
    const auto give_up = std::chrono::steady_clock::now() + 10s;
    while (present(parents).expires == parents.expires && std::chrono::steady_clock::now() < give_up) {
      sender.serve(wall_time());
      receiver.serve(wall_time());
      std::this_thread::sleep_for(2ms);
    }
    return present(parents).expires > parents.expires;
  }

  [[nodiscard]] bool new_participants_meet() const {
    DdsParticipant passive(settings(wearers));
    DdsParticipant active(settings(parents));
    Inbox<TouchEvent> inbox;
    const Reader<TouchEvent> reader(passive, inbox.callback());
    Writer<TouchEvent> writer(active);
    TouchEvent event = example_touch();
    const auto give_up = std::chrono::steady_clock::now() + 10s;
    while (std::chrono::steady_clock::now() < give_up) {
      ++event.sequence;
      (void)writer.write(event);
      if (inbox.wait_for(1, 20ms)) return true;
    }
    return false;
  }

  TemporaryFolder folder;
  UniqueDomain domain;
  PairStore parent{folder / "parent", Side::active};
  PairStore wearer{folder / "wearer", Side::passive};
  Pair parents;
  Pair wearers;
};

TEST_F(APairThatEndsSoon, IsRenewedOverItsLinkAndMeetsWithTheNewFiles) {
  const std::string old_certificate = content(parents.files.certificate);
  {
    DdsParticipant passive(settings(wearers));
    DdsParticipant active(settings(parents));
    RenewalSender sender(wearers, other_session);
    RenewalReceiver receiver(parents);
    sender.connect(passive);
    receiver.connect(active);
    ASSERT_TRUE(renewed(sender, receiver));
    EXPECT_EQ(receiver.dropped(), 0U);
    sender.disconnect();
    receiver.disconnect();
  }
  EXPECT_NE(content(parents.files.certificate), old_certificate);
  const WallTime after = parents.expires + day;
  EXPECT_TRUE(parent.preflight(present(parents), after).empty());
  EXPECT_TRUE(wearer.preflight(present(wearers), after).empty());
  EXPECT_EQ(present(parents).expires, present(wearers).expires);
  EXPECT_TRUE(new_participants_meet());
}

// The wearer's PC was renewed long ago, and has been started again since; the parent's comes last.
TEST_F(APairThatEndsSoon, IsRenewedWhenTheParentsPcComesLater) {
  {
    RenewalSender sender(wearers, example_session);
    sender.serve(wall_time());
  }
  DdsParticipant passive(settings(wearers));
  RenewalSender sender(wearers, other_session);
  sender.connect(passive);
  sender.serve(wall_time());
  DdsParticipant active(settings(parents));
  RenewalReceiver receiver(parents);
  receiver.connect(active);
  EXPECT_TRUE(renewed(sender, receiver));
  // Once only, and the other side of a participant that was replaced is told again.
  const std::string certificate = content(parents.files.certificate);
  sender.disconnect();
  sender.connect(passive);
  Inbox<PairRenewal> told_again;
  const Reader<PairRenewal> reader(active, told_again.callback());
  sender.serve(wall_time());
  ASSERT_TRUE(told_again.wait_for(1));
  receiver.serve(wall_time());
  EXPECT_EQ(content(parents.files.certificate), certificate);
}

// One side renewed, the other not yet: the present certificates are still good.
TEST_F(APairThatEndsSoon, MeetsWhileOnlyTheWearersSideIsRenewed) {
  ASSERT_TRUE(wearer.renew(wearers, wall_time()));
  EXPECT_TRUE(new_participants_meet());
}

TEST_F(APairThatEndsSoon, TakesNoRenewalThatIsNotTheWearers) {
  DdsParticipant active(settings(parents));
  EXPECT_THROW(Writer<PairRenewal> writer(active), DdsError);
  // Even one that came the right way.
  DdsParticipant passive(settings(wearers));
  RenewalReceiver receiver(parents);
  receiver.connect(active);
  Inbox<PairRenewal> inbox;
  const Reader<PairRenewal> reader(active, inbox.callback());
  Writer<PairRenewal> writer(passive);
  PairRenewal forged = example_renewal();
  forged.certificate = content(wearers.files.certificate);
  ASSERT_TRUE(writer.write(forged));
  ASSERT_TRUE(inbox.wait_for(1));
  receiver.serve(wall_time());
  EXPECT_EQ(present(parents).expires, parents.expires);
  EXPECT_TRUE(parent.preflight(parents, wall_time()).empty());
}

TEST(WithoutAPair, NothingIsOfferedNorTaken) {
  const UniqueDomain domain;
  DdsParticipant participant({.domain_id = domain.id(), .partition = domain.partition()});
  RenewalSender sender({}, other_session);
  RenewalReceiver receiver({});
  sender.connect(participant);
  receiver.connect(participant);
  sender.serve(wall_time());
  receiver.serve(wall_time());
  EXPECT_EQ(receiver.dropped(), 0U);
}

}  // namespace
}  // namespace telehug
