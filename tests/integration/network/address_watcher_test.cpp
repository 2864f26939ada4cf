// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <poll.h>
#include <sched.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

#include "network/address_watcher.hpp"

namespace telehug {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

// The test gets a network of its own, so that it neither needs nor disturbs this PC's.
bool enter_own_network() {
  if (unshare(CLONE_NEWNET) == 0) return true;
  const auto user = std::to_string(getuid());
  if (unshare(CLONE_NEWUSER | CLONE_NEWNET) != 0) return false;
  std::ofstream("/proc/self/uid_map") << "0 " << user << " 1";
  return getuid() == 0;
}

bool ip(const std::string& words) {
  std::vector<std::string> parts{"ip"};
  for (std::size_t begin = 0; begin < words.size();) {
    const std::size_t end = std::min(words.find(' ', begin), words.size());
    parts.push_back(words.substr(begin, end - begin));
    begin = end + 1;
  }
  std::vector<char*> arguments;
  for (std::string& part : parts)
    arguments.push_back(part.data());
  arguments.push_back(nullptr);
  pid_t child = 0;
  if (posix_spawnp(&child, "ip", nullptr, nullptr, arguments.data(), environ) != 0) return false;
  int status = 0;
  return waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

// The kernel speaks before `ip` has ended; only whether a carrier is there takes it a moment.
bool changes(AddressWatcher& watcher) {
  for (pollfd descriptor{watcher.fd(), POLLIN, 0}; poll(&descriptor, 1, 5000) > 0;)
    if (watcher.changed()) return true;
  return false;
}

class AddressWatcherInItsOwnNetwork : public testing::Test {
 protected:
  void SetUp() override {
    if (!enter_own_network()) GTEST_SKIP() << "no network namespace may be made here";
    if (!ip("link add left type veth peer name right")) GTEST_SKIP() << "no veth pair can be made here";
    ASSERT_TRUE(ip("link set lo up") && ip("link set left up"));
  }
};

TEST_F(AddressWatcherInItsOwnNetwork, NoticesAddressesThatComeAndGo) {
  ASSERT_TRUE(ip("link set right up"));
  AddressWatcher watcher;
  EXPECT_THAT(watcher.addresses(), IsEmpty());
  ASSERT_TRUE(ip("address add 192.0.2.1/24 dev left"));
  ASSERT_TRUE(changes(watcher));
  EXPECT_THAT(watcher.addresses(), ElementsAre("left 192.0.2.1"));
  ASSERT_TRUE(ip("address add 192.0.2.7/24 dev left"));
  ASSERT_TRUE(changes(watcher));
  EXPECT_THAT(watcher.addresses(), ElementsAre("left 192.0.2.1", "left 192.0.2.7"));
  ASSERT_TRUE(ip("address flush dev left"));
  ASSERT_TRUE(changes(watcher));
  while (!watcher.addresses().empty())
    ASSERT_TRUE(changes(watcher));
  EXPECT_FALSE(watcher.changed());
}

TEST_F(AddressWatcherInItsOwnNetwork, NoticesThatTheCableIsPulledAndPluggedIn) {
  ASSERT_TRUE(ip("address add 192.0.2.1/24 dev left"));
  AddressWatcher watcher;
  EXPECT_THAT(watcher.addresses(), IsEmpty()) << "there is no carrier yet";
  ASSERT_TRUE(ip("link set right up"));
  ASSERT_TRUE(changes(watcher));
  EXPECT_THAT(watcher.addresses(), ElementsAre("left 192.0.2.1"));
  ASSERT_TRUE(ip("link set right down"));
  ASSERT_TRUE(changes(watcher));
  EXPECT_THAT(watcher.addresses(), IsEmpty());
}

TEST_F(AddressWatcherInItsOwnNetwork, TakesARenewedLeaseForNoChange) {
  ASSERT_TRUE(ip("link set right up"));
  ASSERT_TRUE(ip("address add 192.0.2.1/24 dev left valid_lft 600 preferred_lft 600"));
  AddressWatcher watcher;
  while (watcher.addresses().empty())
    ASSERT_TRUE(changes(watcher));
  ASSERT_TRUE(ip("address change 192.0.2.1/24 dev left valid_lft 900 preferred_lft 900"));
  pollfd descriptor{watcher.fd(), POLLIN, 0};
  ASSERT_EQ(poll(&descriptor, 1, 5000), 1) << "the kernel says that something happened";
  EXPECT_FALSE(watcher.changed());
}

TEST_F(AddressWatcherInItsOwnNetwork, DoesNotCountLoopback) {
  AddressWatcher watcher;
  ASSERT_TRUE(ip("address add 127.0.0.9/8 dev lo"));
  EXPECT_FALSE(watcher.changed());
  EXPECT_THAT(watcher.addresses(), IsEmpty());
}

TEST_F(AddressWatcherInItsOwnNetwork, LosesNoChangeWhenTheKernelHadToDropWords) {
  ASSERT_TRUE(ip("link set right up"));
  AddressWatcher watcher;
  const int small = 1;
  ASSERT_EQ(setsockopt(watcher.fd(), SOL_SOCKET, SO_RCVBUF, &small, sizeof small), 0);
  for (int i = 1; i <= 60; ++i)
    ASSERT_TRUE(ip("address add 192.0.2." + std::to_string(i) + "/24 dev left"));
  ASSERT_TRUE(changes(watcher));
  EXPECT_EQ(watcher.addresses().size(), 60U);
}

}  // namespace
}  // namespace telehug
