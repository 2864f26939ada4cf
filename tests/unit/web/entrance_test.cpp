// SPDX-License-Identifier: Apache-2.0
#include "web/entrance.hpp"

#include <gtest/gtest.h>

#include "doubles/fake_clock.hpp"

namespace telehug {
namespace {

class TheEntrance : public testing::Test {
 protected:
  [[nodiscard]] std::optional<std::string> enter(std::string_view link) { return entrance.enter(link, clock.now()); }
  [[nodiscard]] bool knows(std::string_view session) { return entrance.knows(session, clock.now()); }
  [[nodiscard]] std::string link() { return entrance.new_link(clock.now()); }

  FakeClock clock;
  Entrance entrance;
};

TEST_F(TheEntrance, OpensASessionForALinkOnce) {
  const std::string first = link();
  EXPECT_EQ(first.size(), secret_digits);
  const auto session = enter(first);
  ASSERT_TRUE(session);
  EXPECT_NE(*session, first);
  EXPECT_TRUE(knows(*session));
  EXPECT_FALSE(enter(first));
  EXPECT_FALSE(knows(first));
}

TEST_F(TheEntrance, TakesALinkForAMinute) {
  const std::string early = link();
  const std::string late = link();
  clock.advance(Entrance::link_lasts - 1ms);
  EXPECT_TRUE(enter(early));
  clock.advance(1ms);
  EXPECT_FALSE(enter(late));
}

TEST_F(TheEntrance, KnowsNobodyWithoutALink) {
  (void)link();
  const auto session = *enter(link());
  for (const std::string& wrong : {std::string(), session.substr(1), session + "0", std::string(secret_digits, '0'),
                                   std::string(secret_digits, 'x')}) {
    EXPECT_FALSE(enter(wrong)) << wrong;
    EXPECT_FALSE(knows(wrong)) << wrong;
  }
  EXPECT_FALSE(enter(session)) << "a session is no link";
}

TEST_F(TheEntrance, ForgetsASessionThatIsNotUsed) {
  const auto used = *enter(link());
  const auto unused = *enter(link());
  clock.advance(Entrance::session_lasts - 1min);
  EXPECT_TRUE(knows(used));
  clock.advance(1min);
  EXPECT_TRUE(knows(used)) << "it went on with its last request";
  EXPECT_FALSE(knows(unused));
}

TEST_F(TheEntrance, KeepsNoMoreLinksAndSessionsThanItMay) {
  const std::string oldest_link = link();
  for (std::size_t i = 0; i < Entrance::most_links; ++i) {
    clock.advance(1ms);
    (void)link();
  }
  EXPECT_FALSE(enter(oldest_link));

  const auto oldest = *enter(link());
  clock.advance(1ms);
  const auto second = *enter(link());
  clock.advance(1ms);
  EXPECT_TRUE(knows(oldest)) << "which makes the second one that unused for longest";
  for (std::size_t i = 0; i + 1 < Entrance::most_sessions; ++i) {
    clock.advance(1ms);
    EXPECT_TRUE(enter(link()));
  }
  EXPECT_FALSE(knows(second));
  EXPECT_TRUE(knows(oldest));
}

TEST_F(TheEntrance, NeverGivesTheSameSecretTwice) {
  EXPECT_NE(link(), link());
}

}  // namespace
}  // namespace telehug
