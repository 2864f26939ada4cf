// SPDX-License-Identifier: Apache-2.0
#include "web/live_topics.hpp"

#include <gtest/gtest.h>

#include <thread>

namespace telehug {
namespace {

TEST(LiveTopicsOfPages, HoldTheNewestTextOfEach) {
  LiveTopics topics({"news", "weather"});
  EXPECT_EQ(topics.newest("news").version, 0U);
  EXPECT_EQ(topics.newest("news").event, nullptr);
  topics.tell("news", "1");
  topics.tell("news", "2");
  EXPECT_EQ(topics.newest("news").version, 2U);
  EXPECT_EQ(*topics.newest("news").event, "event: news\ndata: 2\n\n");
  EXPECT_EQ(topics.newest("weather").version, 0U);
}

TEST(LiveTopicsOfPages, KeepAnEventForWhoIsStillWritingIt) {
  LiveTopics topics({"news"});
  topics.tell("news", "old");
  const auto writing = topics.newest("news").event;
  topics.tell("news", "new");
  EXPECT_EQ(*writing, "event: news\ndata: old\n\n");
}

TEST(LiveTopicsOfPages, MayBeToldAndReadByDifferentThreads) {
  LiveTopics topics({"news"});
  constexpr int all = 2000;
  std::thread teller([&topics] {
    for (int number = 1; number <= all; ++number)
      topics.tell("news", std::to_string(number));
  });
  std::uint64_t seen = 0;
  while (seen < all) {
    const auto newest = topics.newest("news");
    ASSERT_GE(newest.version, seen);
    seen = newest.version;
    if (seen > 0) {
      ASSERT_EQ(*newest.event, "event: news\ndata: " + std::to_string(seen) + "\n\n");
    }
  }
  teller.join();
}

}  // namespace
}  // namespace telehug
