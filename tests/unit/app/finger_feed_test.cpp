// SPDX-License-Identifier: Apache-2.0
#include "finger_feed.hpp"

#include <gtest/gtest.h>

#include "doubles/allocation_counter.hpp"
#include "doubles/fake_clock.hpp"

namespace telehug {
namespace {

using Json = nlohmann::json;

class FingersOnPages : public testing::Test {
 protected:
  void frame(std::initializer_list<ContactState> contacts = {}) {
    clock.advance(33ms);
    feed.put(ContactStates(contacts.begin(), contacts.end()), clock.now());
  }
  void follow(bool followed) { feed.follow(followed, clock.now()); }
  // Of the frames in the news; empty: there are none.
  std::vector<std::uint64_t> sequences() {
    std::vector<std::uint64_t> all;
    if (const auto news = feed.news())
      for (const Json& one : news->at("frames"))
        all.push_back(one.at("sequence"));
    return all;
  }

  static ContactState finger(std::uint32_t id, Phase phase, ScreenPoint at) {
    ContactState contact;
    contact.id = id;
    contact.phase = phase;
    contact.screen = at;
    return contact;
  }

  FakeClock clock;
  FingerFeed feed;
};

TEST_F(FingersOnPages, AreToldOnlyWhileOneFollows) {
  frame({finger(1, Phase::down, {10, 20})});
  EXPECT_FALSE(feed.news());
  EXPECT_FALSE(feed.wanted());
  follow(true);
  EXPECT_TRUE(feed.wanted());
  frame({finger(7, Phase::move, {10.5, 20.25}), finger(9, Phase::up, {1, 2})});
  EXPECT_EQ(feed.news(), Json({{"frames",
                                {{{"sequence", 1},
                                  {"frame_time_ns", to_ns(clock.now())},
                                  {"contacts",
                                   {{{"id", 7}, {"phase", "move"}, {"x_mm", 10.5}, {"y_mm", 20.25}},
                                    {{"id", 9}, {"phase", "up"}, {"x_mm", 1}, {"y_mm", 2}}}}}}}}));
  EXPECT_FALSE(feed.news()) << "nothing new";
}

TEST_F(FingersOnPages, AreRepeatedSoThatMissedNewsLoseNothing) {
  follow(true);
  for (int i = 0; i < 3; ++i)
    frame();
  EXPECT_EQ(sequences(), (std::vector<std::uint64_t>{1, 2, 3}));
  for (int i = 0; i < 7; ++i)
    frame();
  EXPECT_EQ(sequences(), (std::vector<std::uint64_t>{3, 4, 5, 6, 7, 8, 9, 10}));
}

TEST_F(FingersOnPages, AreAllThereAfterHousekeepingWasLate) {
  follow(true);
  for (int i = 0; i < 40; ++i)
    frame();
  EXPECT_EQ(sequences().size(), 40U);
  for (int i = 0; i < 200; ++i)
    frame();
  const auto late = sequences();
  EXPECT_EQ(late.size(), 64U);
  frame();
  EXPECT_EQ(sequences().back(), 241U) << "what was lost is counted";
}

TEST_F(FingersOnPages, AreMeantForThePageStillAMomentAfterItHasGoneAndNoLonger) {
  follow(true);
  frame({finger(1, Phase::down, {10, 20})});
  ASSERT_FALSE(sequences().empty());
  follow(true);
  clock.advance(FingerFeed::lingers - 1ms);
  follow(false);
  EXPECT_TRUE(feed.wanted()) << "a page that is loaded anew is back by then";
  clock.advance(1ms);
  follow(false);
  EXPECT_FALSE(feed.wanted());
  EXPECT_EQ(feed.news(), Json({{"frames", Json::array()}})) << "no later page takes the old news for its own";
  EXPECT_FALSE(feed.news());
  follow(true);
  frame();
  EXPECT_EQ(sequences().size(), 1U) << "nothing of before";
}

TEST_F(FingersOnPages, AllocateNothingOnTheTouchPath) {
  if (!allocations_are_counted()) GTEST_SKIP() << "the sanitizer has a heap of its own";
  follow(true);
  const ContactStates contacts(max_contacts, finger(1, Phase::move, {10, 20}));
  const std::uint64_t before = allocation_count();
  for (int i = 0; i < 200; ++i)
    feed.put(contacts, clock.now());
  EXPECT_EQ(allocation_count() - before, 0U);
}

}  // namespace
}  // namespace telehug
