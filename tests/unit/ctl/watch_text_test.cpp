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

}  // namespace
}  // namespace telehug
