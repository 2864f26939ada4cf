// SPDX-License-Identifier: Apache-2.0
//
// What the link faults are measured with must itself do what it says.
#include "netlab/two_homes.hpp"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <memory>
#include <system_error>

namespace telehug {
namespace {

constexpr std::uint16_t port = 7411;

// A program in the child's home that hears datagrams.
class Listener {
 public:
  explicit Listener(const TwoHomes& homes) {
    const InsideNamespace inside(homes.network(Home::child));
    descriptor_ = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    sockaddr_in here{};
    here.sin_family = AF_INET;
    here.sin_port = htons(port);
    EXPECT_EQ(bind(descriptor_, reinterpret_cast<const sockaddr*>(&here), sizeof here), 0);
  }
  ~Listener() { close(descriptor_); }
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;

  // The first byte of the next datagram; nothing if none comes in that time.
  [[nodiscard]] std::optional<int> hear(std::chrono::microseconds longest = 2s) const {
    const timeval wait{longest / 1s, longest.count() % 1'000'000};
    setsockopt(descriptor_, SOL_SOCKET, SO_RCVTIMEO, &wait, sizeof wait);
    std::uint8_t first = 0;
    if (recv(descriptor_, &first, 1, MSG_TRUNC) <= 0) return std::nullopt;
    return first;
  }

 private:
  int descriptor_ = -1;
};

class TwoHomesTest : public testing::Test {
 protected:
  void SetUp() override {
    try {
      homes = std::make_unique<TwoHomes>(20261129);
    } catch (const std::system_error& error) {
      GTEST_SKIP() << "network namespaces are not permitted here: " << error.what();
    }
    listener = std::make_unique<Listener>(*homes);
    say(99);  // the neighbours get to know each other
    ASSERT_EQ(listener->hear(), 99);
  }
  void say(std::uint8_t what) const { homes->send_datagram(Home::parent, port, {what}); }

  std::unique_ptr<TwoHomes> homes;
  std::unique_ptr<Listener> listener;
};

TEST_F(TwoHomesTest, LetsNothingThroughWhileTheWayIsCut) {
  homes->set(Home::parent, {.loss = 1});
  say(1);
  EXPECT_EQ(listener->hear(100ms), std::nullopt);
  homes->set(Home::parent, {});
  say(2);
  EXPECT_EQ(listener->hear(), 2);
}

TEST_F(TwoHomesTest, LetsNothingThroughWhileAPlugIsPulled) {
  homes->pull_plug(Home::child);
  say(1);
  EXPECT_EQ(listener->hear(100ms), std::nullopt);
  homes->put_in_plug(Home::child);
  // The kernel tells the carrier's return when it finds time.
  std::optional<int> heard;
  for (int i = 0; i < 50 && !heard; ++i) {
    say(2);
    heard = listener->hear(100ms);
  }
  EXPECT_TRUE(heard);
}

TEST_F(TwoHomesTest, LosesAsManyAsItIsTold) {
  homes->set(Home::parent, {.loss = 0.2});
  for (std::uint8_t i = 0; i < 250; ++i)
    say(i);
  int heard = 0;
  while (listener->hear(200ms))
    ++heard;
  EXPECT_NEAR(heard, 200, 20);
}

TEST_F(TwoHomesTest, LetsOnlyThePortThroughThatItIsTold) {
  homes->let_only_pass(port + 1);
  say(1);
  EXPECT_EQ(listener->hear(100ms), std::nullopt);
  homes->let_only_pass(port);
  say(2);
  EXPECT_EQ(listener->hear(), 2);
}

TEST_F(TwoHomesTest, DelaysAndDoubles) {
  homes->set(Home::parent, {.delay = 80ms, .doubled = 1});
  const Timestamp before = SteadyClock{}.now();
  say(7);
  EXPECT_EQ(listener->hear(), 7);
  EXPECT_GE(SteadyClock{}.now() - before, 80ms);
  EXPECT_EQ(listener->hear(), 7);
  EXPECT_EQ(listener->hear(100ms), std::nullopt);
}

TEST_F(TwoHomesTest, LetsLaterPacketsOvertakeThoseHeldBack) {
  homes->set(Home::parent, {.held_back = 1, .held_back_for = 300ms});
  const Timestamp before = SteadyClock{}.now();
  say(1);
  // It entered the way while that held packets back.
  while (SteadyClock{}.now() - before < 100ms)
    std::this_thread::yield();
  homes->set(Home::parent, {});
  say(2);
  EXPECT_EQ(listener->hear(), 2);
  EXPECT_EQ(listener->hear(), 1);
}

TEST_F(TwoHomesTest, RecordsAndReplays) {
  homes->record(Home::parent);
  say(5);
  ASSERT_EQ(listener->hear(), 5);
  std::vector<CapturedPacket> datagrams;
  for (CapturedPacket& packet : homes->take_recording(Home::parent))
    if (udp_content(packet.frame)) datagrams.push_back(std::move(packet));
  ASSERT_EQ(datagrams.size(), 1U);
  EXPECT_EQ(udp_content(datagrams[0].frame)->payload, Bytes{5});
  EXPECT_EQ(udp_content(datagrams[0].frame)->port, port);
  homes->replay(Home::parent, datagrams);
  EXPECT_EQ(listener->hear(), 5);
}

}  // namespace
}  // namespace telehug
