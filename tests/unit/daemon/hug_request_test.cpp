// SPDX-License-Identifier: Apache-2.0
#include "daemon/hug_request.hpp"

#include <gtest/gtest.h>

namespace telehug {
namespace {

using nlohmann::json;

TEST(AHugRequest, IsModerateUnlessItSaysHow) {
  const auto hug = read_hug_request({{"command", "hug"}});
  ASSERT_TRUE(hug);
  EXPECT_FALSE(hug->duration);
  EXPECT_EQ(hug->strength, HugRequest::usual_strength);
}

TEST(AHugRequest, SaysForHowLongAndHowStrong) {
  const auto hug = read_hug_request({{"seconds", 4}, {"strength", 0.25}});
  ASSERT_TRUE(hug);
  EXPECT_EQ(hug->duration, Duration(4s));
  EXPECT_EQ(hug->strength, 0.25);
}

TEST(AHugRequest, IsRefusedWithASentenceBeyondItsLimits) {
  for (const json& seconds : {json(0.4), json(10.1), json(-1), json("long"), json(nullptr), json(1e300)}) {
    const auto hug = read_hug_request({{"seconds", seconds}});
    ASSERT_FALSE(hug) << seconds;
    EXPECT_EQ(hug.error().message, "\"seconds\" is a number from 0.5 to 10");
  }
  for (const json& strength : {json(0), json(1.01), json(-1), json("strong"), json::array()}) {
    const auto hug = read_hug_request({{"strength", strength}});
    ASSERT_FALSE(hug) << strength;
    EXPECT_EQ(hug.error().message, "\"strength\" is a number above 0, up to 1");
  }
}

}  // namespace
}  // namespace telehug
