// SPDX-License-Identifier: Apache-2.0
#include "dds/strangers.hpp"

#include <gtest/gtest.h>

#include "doubles/fake_clock.hpp"

namespace telehug {
namespace {

constexpr Strangers::Id first{1};
constexpr Strangers::Id second{2};

class StrangersTest : public testing::Test {
 protected:
  void come(const Strangers::Id& id, const std::string& address) { strangers.discovered(id, address, clock.now()); }
  [[nodiscard]] std::optional<Stranger> here() const { return strangers.longest_here(clock.now()); }

  FakeClock clock;
  Strangers strangers;
};

TEST_F(StrangersTest, AreNotThosePresentWhoProvedThemselves) {
  come(first, "192.0.2.1");
  strangers.proved(first);
  clock.advance(1h);
  EXPECT_EQ(here(), std::nullopt);
  EXPECT_EQ(strangers.refusals(), 0U);
}

TEST_F(StrangersTest, AreThoseRefusedAtOnce) {
  come(first, "192.0.2.1");
  strangers.refused(first);
  EXPECT_EQ(here(), (Stranger{"192.0.2.1", true}));
}

TEST_F(StrangersTest, AreThoseWhoDoNotProveThemselvesInTime) {
  come(first, "192.0.2.1");
  clock.advance(Strangers::longest_handshake - 1ms);
  EXPECT_EQ(here(), std::nullopt);
  clock.advance(1ms);
  EXPECT_EQ(here(), (Stranger{"192.0.2.1", false}));
  strangers.proved(first);
  EXPECT_EQ(here(), std::nullopt);
}

TEST_F(StrangersTest, AreCountedOnceHoweverOftenTheyTry) {
  come(first, "192.0.2.1");
  for (int i = 0; i < 10; ++i)
    strangers.refused(first);
  come(second, "192.0.2.2");
  strangers.refused(second);
  EXPECT_EQ(strangers.refusals(), 2U);
}

TEST_F(StrangersTest, AreToldOneByOneSoThatTheSentenceStaysTheSame) {
  come(first, "192.0.2.1");
  come(second, "192.0.2.2");
  strangers.refused(second);
  strangers.refused(first);
  EXPECT_EQ(here()->address, "192.0.2.1");
  strangers.gone(first);
  EXPECT_EQ(here()->address, "192.0.2.2");
  strangers.gone(second);
  EXPECT_EQ(here(), std::nullopt);
}

// Anybody can send a handshake in another's name.
TEST_F(StrangersTest, AreNotMadeOfThePeerByWhoeverSpoilsAHandshakeInItsName) {
  come(first, "192.0.2.1");
  strangers.proved(first);
  strangers.refused(first);
  EXPECT_EQ(here(), std::nullopt);
}

TEST_F(StrangersTest, AreRememberedOnlyUpToALimit) {
  for (std::uint8_t i = 0; i < 200; ++i) {
    come({i, 9}, "192.0.2.1");
    strangers.refused({i, 9});
  }
  EXPECT_EQ(strangers.refusals(), Strangers::most_remembered);
}

}  // namespace
}  // namespace telehug
