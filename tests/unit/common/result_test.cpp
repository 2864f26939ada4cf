// SPDX-License-Identifier: Apache-2.0
#include "common/result.hpp"

#include <gtest/gtest.h>

namespace telehug {
namespace {

TEST(Result, HoldsAValueOrAnError) {
  const Result<int> good = 5;
  const Result<int> bad = Error{"no camera"};
  ASSERT_TRUE(good.ok());
  EXPECT_EQ(*good, 5);
  ASSERT_FALSE(bad);
  EXPECT_EQ(bad.error().message, "no camera");
}

TEST(Result, ThrowsWhenTheValueOfAnErrorIsRead) {
  const Result<int> bad = Error{"no camera"};
  EXPECT_THROW((void)bad.value(), std::bad_variant_access);
}

}  // namespace
}  // namespace telehug
