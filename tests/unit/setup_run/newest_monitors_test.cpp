// SPDX-License-Identifier: Apache-2.0
#include "setup_run/newest_monitors.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <future>
#include <memory>
#include <vector>

namespace telehug {
namespace {

std::vector<SizedMonitor> monitors(int count) {
  return std::vector<SizedMonitor>(static_cast<std::size_t>(count));
}

TEST(TheNewestMonitors, AreAskedForEachTime) {
  auto there = std::make_shared<std::atomic<int>>(1);
  NewestMonitors offers([there] { return monitors(*there); });
  EXPECT_EQ(offers.newest().size(), 1U);
  *there = 2;
  EXPECT_EQ(offers.newest().size(), 2U);
}

TEST(TheNewestMonitors, AreThoseHeardOfLastWhileTheXServerHangs) {
  std::promise<void> mended;
  std::promise<void> over;
  {
    auto asked = std::make_shared<std::atomic<int>>(0);
    auto end = std::shared_ptr<int>(new int(0), [&over](const int* kept) {
      delete kept;
      over.set_value();
    });
    NewestMonitors offers([asked, end = std::move(end), mends = mended.get_future().share()] {
      if (++*asked > 2) mends.wait();
      return monitors(3);
    });
    EXPECT_EQ(offers.newest().size(), 3U);
    while (*asked < 3)
      EXPECT_EQ(offers.newest().size(), 3U);
    EXPECT_EQ(offers.newest().size(), 3U) << "though nothing answers";
  }  // and nobody waits for it
  mended.set_value();
  over.get_future().wait();
}

}  // namespace
}  // namespace telehug
