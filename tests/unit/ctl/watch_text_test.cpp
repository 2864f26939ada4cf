// SPDX-License-Identifier: Apache-2.0
#include "ctl/watch_text.hpp"

#include <gtest/gtest.h>

namespace telehug {
namespace {

TEST(WatchText, IsOneLineAnEvent) {
  EXPECT_EQ(watch_text({{"side", "active"}, {"event", "touch"}, {"box", 7}, {"phase", "do\nwn"}}),
            "active   touch      box=7 phase=do?wn");
  EXPECT_EQ(watch_text(nlohmann::json::object()), "-        -         ");
}

// Texts of the peer must not steer the terminal: neither by ASCII's control characters nor by those of ISO 8859, of
// which U+009B begins commands.
TEST(WatchText, HoldsNoControlCharacters) {
  EXPECT_EQ(watch_text({{"side", "\x1B[2J"}, {"event", "\xC2\x9B[2J"}, {"\xC2\x85", "\xC2\xA0\xC2\xC2\x80"}}),
            "?[2J     ?[2J       ?=\xC2\xA0\xC2?");
}

}  // namespace
}  // namespace telehug
