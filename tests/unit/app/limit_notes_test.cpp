// SPDX-License-Identifier: Apache-2.0
#include "limit_notes.hpp"

#include <gmock/gmock.h>

namespace telehug {
namespace {

using testing::HasSubstr;

TEST(LimitNotes, say_what_was_limited_once_a_minute) {
  LimitNotes notes;
  SafetyCounters counters;
  Timestamp now = from_ns(5'000'000'000);
  EXPECT_EQ(notes.next(counters, now), std::nullopt);
  counters.limited_by_current = 3;
  const auto first = notes.next(counters, now);
  ASSERT_TRUE(first);
  EXPECT_THAT(*first, HasSubstr("3 commands to more motors at once"));
  counters.limited_by_current = 50;
  counters.limited_by_duty = 7;
  EXPECT_EQ(notes.next(counters, now + 59s), std::nullopt);
  const auto second = notes.next(counters, now + 60s);
  ASSERT_TRUE(second);
  EXPECT_THAT(*second, HasSubstr("7 commands to motors that have run"));
  EXPECT_THAT(*second, HasSubstr("47 commands to more motors"));
  EXPECT_EQ(notes.next(counters, now + 300s), std::nullopt) << "nothing new";
}

}  // namespace
}  // namespace telehug
