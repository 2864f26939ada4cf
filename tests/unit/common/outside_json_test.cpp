// SPDX-License-Identifier: Apache-2.0
#include "common/outside_json.hpp"

#include <gtest/gtest.h>

namespace telehug {
namespace {

std::string nested(std::size_t levels) {
  return std::string(levels, '[') + std::string(levels, ']');
}

TEST(JsonFromOutside, IsReadAsUsual) {
  const auto json = parse_outside_json(R"({"a":[1,{"b":null}]})");
  EXPECT_EQ(json, nlohmann::json({{"a", {1, {{"b", nullptr}}}}}));
}

TEST(JsonFromOutside, IsDiscardedIfItIsNone) {
  for (const char* text : {"", "{", "{\"a\":}", "\"\xFF\"", "1 2"})
    EXPECT_TRUE(parse_outside_json(text).is_discarded()) << text;
}

TEST(JsonFromOutside, IsDiscardedIfItIsNestedTooDeeplyToBePrinted) {
  EXPECT_FALSE(parse_outside_json(nested(deepest_json)).is_discarded());
  for (const std::size_t levels : {std::size_t{100}, std::size_t{8} << 20U}) {
    EXPECT_TRUE(parse_outside_json(nested(levels)).is_discarded());
    EXPECT_TRUE(parse_outside_json("{\"a\":" + nested(levels) + "}").is_discarded());
  }
}

}  // namespace
}  // namespace telehug
