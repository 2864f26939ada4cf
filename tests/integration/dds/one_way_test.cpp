// SPDX-License-Identifier: Apache-2.0
#include "peer_link/one_way.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <optional>
#include <thread>

#include "doubles/example_messages.hpp"
#include "doubles/inbox.hpp"
#include "doubles/unique_domain.hpp"

namespace telehug {
namespace {

class OneWay : public testing::Test {
 protected:
  [[nodiscard]] DdsSettings settings(Side side) const {
    return {.side = side, .domain_id = domain.id(), .partition = domain.partition()};
  }
  static bool eventually(const std::function<bool()>& holds) {
    const auto give_up = std::chrono::steady_clock::now() + 10s;
    while (std::chrono::steady_clock::now() < give_up) {
      if (holds()) return true;
      std::this_thread::sleep_for(2ms);
    }
    return false;
  }
  // Neither end knows at the same moment as the other that they are connected: until it is heard.
  bool goes_through() {
    const std::size_t before = inbox.messages().size();
    return eventually([&] { return outgoing.write(example_hug()) && inbox.wait_for(before + 1, 20ms); });
  }

  UniqueDomain domain;
  std::optional<DdsParticipant> active{std::in_place, settings(Side::active)};
  std::optional<DdsParticipant> passive{std::in_place, settings(Side::passive)};
  Inbox<Hug> inbox;
  Outgoing<Hug> outgoing;
  Incoming<Hug> incoming{inbox.callback()};
};

TEST_F(OneWay, AMessageThatNobodyCouldReadIsNotTakenForSent) {
  EXPECT_FALSE(outgoing.write(example_hug())) << "it is not connected";
  outgoing.connect(*passive);
  EXPECT_FALSE(outgoing.write(example_hug())) << "nobody is there";
  incoming.connect(*active);
  EXPECT_TRUE(goes_through());
}

TEST_F(OneWay, MessagesGoThroughAfterEitherParticipantWasReplaced) {
  outgoing.connect(*passive);
  incoming.connect(*active);
  ASSERT_TRUE(goes_through());

  outgoing.disconnect();
  passive.reset();
  EXPECT_FALSE(outgoing.write(example_hug()));
  outgoing.connect(passive.emplace(settings(Side::passive)));
  EXPECT_TRUE(goes_through());

  incoming.disconnect();
  active.reset();
  EXPECT_TRUE(eventually([&] { return !outgoing.write(example_hug()); }));
  incoming.connect(active.emplace(settings(Side::active)));
  EXPECT_TRUE(goes_through());
  EXPECT_EQ(incoming.dropped(), 0U);
}

}  // namespace
}  // namespace telehug
