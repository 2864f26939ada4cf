// SPDX-License-Identifier: Apache-2.0
#include "publish/hug_player.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "doubles/allocation_counter.hpp"
#include "doubles/fake_clock.hpp"

namespace telehug {
namespace {

constexpr Duration frame = 20ms;

class AHug : public testing::Test {
 protected:
  const BoxedContacts& play_after(Duration time = frame) {
    clock.advance(time);
    return hug.play(clock.now());
  }
  // The strength of each frame until nobody is hugged any more.
  std::vector<double> play_to_the_end() {
    std::vector<double> strengths;
    while (true) {
      const BoxedContacts& contacts = play_after();
      if (contacts.empty()) return strengths;
      strengths.push_back(contacts[0].strength);
    }
  }

  FakeClock clock;
  HugPlayer hug;
};

TEST_F(AHug, IsNotThereUntilItIsAskedFor) {
  EXPECT_FALSE(hug.runs());
  EXPECT_TRUE(play_after().empty());
}

TEST_F(AHug, BeginsWithADownIsHeldAndEndsWithAnUp) {
  hug.begin({.duration = 1s}, clock.now());
  const Timestamp begun = clock.now();
  for (const BoxedContact& contact : play_after())
    EXPECT_EQ(contact.phase, Phase::down);
  while (clock.now() + frame < begun + 1s) {
    const BoxedContacts& contacts = play_after();
    ASSERT_EQ(contacts.size(), HugPlayer::contacts_a_hug);
    for (const BoxedContact& contact : contacts)
      ASSERT_EQ(contact.phase, Phase::move);
  }
  const BoxedContacts& last = play_after();
  ASSERT_EQ(last.size(), HugPlayer::contacts_a_hug);
  for (const BoxedContact& contact : last)
    EXPECT_EQ(contact.phase, Phase::up);
  EXPECT_FALSE(hug.runs());
  EXPECT_TRUE(play_after().empty());
}

TEST_F(AHug, LiesOnBothSidesOfTheBodyInTheMiddleOfBoxesOfTheStandardGrid) {
  hug.begin({}, clock.now());
  int right = 0;
  int left = 0;
  std::set<int> boxes;
  for (const BoxedContact& contact : play_after()) {
    EXPECT_EQ(contact.gesture, Gesture::hug);
    EXPECT_EQ(contact.grid, (GridShape{.columns = 5, .rows = 4}));
    (contact.body.x_fh < 0 ? right : left) += 1;
    const int column = static_cast<int>(std::floor(contact.body.x_fh / 0.5 + 2.5));
    const int row = static_cast<int>(std::floor(contact.body.y_fh / 0.5));
    EXPECT_EQ(contact.box, row * 5 + column + 1);
    boxes.insert(contact.box);
  }
  EXPECT_EQ(right, 2);
  EXPECT_EQ(left, 2);
  EXPECT_EQ(boxes, (std::set<int>{6, 10, 12, 14}));
}

TEST_F(AHug, RisesAndFallsGentlyAndIsHeldInBetween) {
  hug.begin({.duration = 2500ms, .strength = 0.8}, clock.now());
  const std::vector<double> strengths = play_to_the_end();
  EXPECT_DOUBLE_EQ(strengths.front(), 0.15);
  EXPECT_NEAR(strengths.back(), 0.15, 0.05);
  EXPECT_DOUBLE_EQ(*std::ranges::max_element(strengths), 0.8);
  for (std::size_t i = 1; i < strengths.size(); ++i)
    EXPECT_LE(std::abs(strengths[i] - strengths[i - 1]), 0.04) << "frame " << i;
  const auto held = std::ranges::count(strengths, 0.8);
  EXPECT_GT(held * frame, 1500ms);
  EXPECT_LT(held * frame, 2s);
}

TEST_F(AHug, IsNeverStrongerThanAskedFor) {
  hug.begin({.duration = 1s, .strength = 0.1}, clock.now());
  for (const double strength : play_to_the_end())
    EXPECT_DOUBLE_EQ(strength, 0.1);
}

TEST_F(AHug, ThatIsShortTurnsBackHalfWay) {
  hug.begin({.duration = 500ms}, clock.now());
  const std::vector<double> strengths = play_to_the_end();
  const auto highest = std::ranges::max_element(strengths);
  EXPECT_LT(*highest, 0.7);
  EXPECT_GT(*highest, 0.4);
  EXPECT_NEAR(strengths.back(), 0.15, 0.05);
}

TEST_F(AHug, LastsTenSecondsAtTheMost) {
  hug.begin({.duration = 1h}, clock.now());
  EXPECT_EQ(play_to_the_end().size(), 10s / frame);
}

TEST_F(AHug, IsProlongedByAnotherOneAndStaysTheSameContacts) {
  hug.begin({.duration = 1s}, clock.now());
  const std::uint32_t id = play_after()[0].id;
  for (int i = 0; i < 45; ++i)
    play_after();  // it falls already
  const double before = play_after()[0].strength;
  EXPECT_LT(before, 1);
  hug.begin({.duration = 2s, .strength = 0.5}, clock.now());
  const BoxedContacts& after = play_after();
  EXPECT_EQ(after[0].id, id);
  EXPECT_EQ(after[0].phase, Phase::move);
  EXPECT_NEAR(after[0].strength, before, 0.04);
  const std::vector<double> strengths = play_to_the_end();
  EXPECT_EQ(strengths.size() + 1, 2s / frame);
  EXPECT_DOUBLE_EQ(strengths[strengths.size() / 2], 0.5);
}

TEST_F(AHug, IsNotShortenedByAnotherOne) {
  hug.begin({.duration = 3s}, clock.now());
  play_after();
  hug.begin({.duration = 500ms}, clock.now());
  EXPECT_EQ(play_to_the_end().size() + 1, 3s / frame);
}

TEST_F(AHug, HasIdsOfItsOwnThatNoFingerGets) {
  std::set<std::uint32_t> ids;
  for (int i = 0; i < 5; ++i) {
    hug.begin({.duration = 500ms}, clock.now());
    for (const BoxedContact& contact : play_after()) {
      EXPECT_GE(contact.id, HugPlayer::id_bit);
      EXPECT_TRUE(ids.insert(contact.id).second);
    }
    play_to_the_end();
  }
}

TEST_F(AHug, ThatIsBrokenOffIsGone) {
  hug.begin({}, clock.now());
  play_after();
  hug.break_off();
  EXPECT_FALSE(hug.runs());
  EXPECT_TRUE(play_after().empty());
}

TEST_F(AHug, ThatCouldNotBeBegunInTimeIsLeftOut) {
  hug.begin({.duration = 1s}, clock.now());
  EXPECT_TRUE(play_after(1s).empty());
  EXPECT_FALSE(hug.runs());
}

TEST_F(AHug, IsPlayedWithoutAllocating) {
  if (!allocations_are_counted()) GTEST_SKIP() << "the sanitizer has a heap of its own";
  const std::uint64_t before = allocation_count();
  for (int i = 0; i < 3; ++i) {
    hug.begin({}, clock.now());
    while (hug.runs())
      play_after();
  }
  EXPECT_EQ(allocation_count(), before);
}

}  // namespace
}  // namespace telehug
