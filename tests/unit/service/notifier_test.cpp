// SPDX-License-Identifier: Apache-2.0
#include "service/notifier.hpp"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <cstring>

#include "doubles/fake_clock.hpp"
#include "doubles/temporary_folder.hpp"

namespace telehug {
namespace {

// Stands for systemd: the datagram socket that $NOTIFY_SOCKET names.
class NotifierTest : public testing::Test {
 protected:
  NotifierTest() : fd_(socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
    const std::string path = (folder_.path() / "notify").string();
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strncpy(address.sun_path, path.c_str(), sizeof(address.sun_path) - 1);
    EXPECT_EQ(bind(fd_, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
    setenv("NOTIFY_SOCKET", path.c_str(), 1);
  }
  ~NotifierTest() override {
    close(fd_);
    for (const char* name : {"NOTIFY_SOCKET", "WATCHDOG_USEC", "WATCHDOG_PID"})
      unsetenv(name);
  }
  // The oldest message that was sent, or "nothing".
  std::string told() const {
    std::array<char, 1024> buffer{};
    const ssize_t size = recv(fd_, buffer.data(), buffer.size(), MSG_DONTWAIT);
    return size < 0 ? "nothing" : std::string(buffer.data(), static_cast<std::size_t>(size));
  }
  TemporaryFolder folder_;
  int fd_;
};

TEST_F(NotifierTest, TellsSystemdOfTheDaemonsStates) {
  const Notifier notifier;
  notifier.ready();
  EXPECT_EQ(told(), "READY=1");
  notifier.status("waiting\nMAINPID=1");
  EXPECT_EQ(told(), "STATUS=waiting MAINPID=1");
  notifier.reloading(from_ns(3'000'004'999));
  EXPECT_EQ(told(), "RELOADING=1\nMONOTONIC_USEC=3000004");
  notifier.stopping();
  EXPECT_EQ(told(), "STOPPING=1");
}

TEST_F(NotifierTest, FeedsTheWatchdogAtHalfItsInterval) {
  setenv("WATCHDOG_USEC", "2000000", 1);
  Notifier notifier;
  EXPECT_EQ(notifier.watchdog_interval(), Duration(2s));
  FakeClock clock;
  notifier.alive(clock.now());
  EXPECT_EQ(told(), "WATCHDOG=1");
  clock.advance(900ms);
  notifier.alive(clock.now());
  EXPECT_EQ(told(), "nothing");
  clock.advance(200ms);
  notifier.alive(clock.now());
  EXPECT_EQ(told(), "WATCHDOG=1");
}

TEST_F(NotifierTest, FeedsNoWatchdogWhileHousekeepingHangs) {
  setenv("WATCHDOG_USEC", "2000000", 1);
  Notifier notifier;
  FakeClock clock;
  const auto is_fed_after = [&](Duration time) {
    clock.advance(time);
    notifier.alive(clock.now());
    return told() == "WATCHDOG=1";
  };
  EXPECT_TRUE(is_fed_after(0s)) << "before the first round";
  EXPECT_TRUE(is_fed_after(59s));
  EXPECT_FALSE(is_fed_after(1s)) << "there never was one";
  notifier.keeps_house(clock.now());
  EXPECT_TRUE(is_fed_after(1s));
  EXPECT_TRUE(is_fed_after(58s));
  EXPECT_FALSE(is_fed_after(1s));
  EXPECT_FALSE(is_fed_after(100s));
  notifier.keeps_house(clock.now());
  EXPECT_TRUE(is_fed_after(1s)) << "it goes on";
}

TEST_F(NotifierTest, LeavesTheWatchdogAloneWhenThereIsNone) {
  Notifier notifier;
  notifier.alive(FakeClock().now());
  EXPECT_EQ(told(), "nothing");
}

TEST(NotifierWithoutSystemd, DoesNothing) {
  unsetenv("NOTIFY_SOCKET");
  Notifier notifier;
  notifier.ready();
  notifier.status("all is well");
  notifier.alive(FakeClock().now());
  notifier.stopping();
  EXPECT_FALSE(notifier.watchdog_interval());
}

}  // namespace
}  // namespace telehug
