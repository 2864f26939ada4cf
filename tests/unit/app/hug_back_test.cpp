// SPDX-License-Identifier: Apache-2.0
#include "hug_back.hpp"

#include <gtest/gtest.h>

#include "dds/validate.hpp"
#include "doubles/example_messages.hpp"
#include "doubles/fake_clock.hpp"

namespace telehug {
namespace {

TEST(AHugBack, SaysWhoseItIsAndCountsOn) {
  FakeClock clock;
  HugBack hugs(example_session);
  const auto first = hugs.next(0.5, clock.now());
  ASSERT_TRUE(first);
  EXPECT_EQ(validate(*first), nullptr);
  EXPECT_EQ(first->session, example_session);
  EXPECT_EQ(first->sequence, 1U);
  EXPECT_EQ(first->sent_time_ns, to_ns(clock.now()));
  EXPECT_EQ(first->strength, 0.5);
  clock.advance(1s);
  EXPECT_EQ(hugs.next(0.5, clock.now())->sequence, 2U);
}

TEST(AHugBack, GoesOutOnceASecondHoweverOftenTheButtonIsPressed) {
  FakeClock clock;
  HugBack hugs(example_session);
  int sent = 0;
  for (int press = 0; press < 100; ++press) {
    sent += hugs.next(1, clock.now()) ? 1 : 0;
    clock.advance(30ms);
  }
  EXPECT_EQ(sent, 3);
}

}  // namespace
}  // namespace telehug
