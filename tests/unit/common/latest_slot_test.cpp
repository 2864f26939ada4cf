// SPDX-License-Identifier: Apache-2.0
#include "common/latest_slot.hpp"

#include <gtest/gtest.h>

#include <thread>

namespace telehug {
namespace {

TEST(LatestSlot, IsEmptyAtFirst) {
  LatestSlot<int> slot;
  EXPECT_FALSE(slot.take().has_value());
}

TEST(LatestSlot, HandsOverTheNewestValueOnceAndSaysThatAnOlderOneWasReplaced) {
  LatestSlot<int> slot;
  EXPECT_FALSE(slot.put(1));
  EXPECT_TRUE(slot.put(2));
  EXPECT_EQ(slot.take(), 2);
  EXPECT_FALSE(slot.take().has_value());
}

TEST(LatestSlot, TakesWithoutWaitingWhenAsked) {
  LatestSlot<int> slot;
  EXPECT_FALSE(slot.try_take().has_value());
  slot.put(3);
  EXPECT_EQ(slot.try_take(), 3);
}

TEST(LatestSlot, GivesUpWaitingAtTheDeadline) {
  LatestSlot<int> slot;
  EXPECT_FALSE(slot.wait_and_take(std::chrono::steady_clock::now() + 1ms).has_value());
}

TEST(LatestSlot, WakesAReaderThatWaits) {
  LatestSlot<int> slot;
  std::thread writer([&slot] { slot.put(7); });
  EXPECT_EQ(slot.wait_and_take(std::chrono::steady_clock::now() + 10s), 7);
  writer.join();
}

}  // namespace
}  // namespace telehug
