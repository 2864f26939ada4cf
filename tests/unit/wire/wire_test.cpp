// SPDX-License-Identifier: Apache-2.0
#include "wire/wire.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/ioctl.h>

#include "doubles/ioctl_double.hpp"
#include "doubles/socket_pair.hpp"

namespace telehug {
namespace {

using ::testing::ElementsAre;

const std::vector<std::uint8_t> frame(64, 7);

TEST(Wire, CarriesBytesBothWaysWithoutWaiting) {
  SocketPair pair;
  Wire wire(pair.give());
  std::array<std::uint8_t, 16> buffer{};
  EXPECT_EQ(wire.read(buffer), 0U);
  pair.write(std::vector<std::uint8_t>{1, 2, 3});
  EXPECT_EQ(wire.read(buffer), 3U);
  EXPECT_EQ(buffer[2], 3);
  EXPECT_EQ(wire.write(std::vector<std::uint8_t>{4, 5}), 2U);
  EXPECT_THAT(pair.read(), ElementsAre(4, 5));
}

TEST(Wire, TellsThatTheOtherEndIsGone) {
  SocketPair pair;
  Wire wire(pair.give());
  pair.close_own();
  std::array<std::uint8_t, 16> buffer{};
  EXPECT_EQ(wire.read(buffer), std::nullopt);
  EXPECT_EQ(wire.write(frame), std::nullopt) << "and no signal has ended this program";
}

TEST(Wire, EndsTheConnectionOfWhichSomebodyHoldsACopy) {
  SocketPair pair;
  const int given = pair.give();
  const int copy = dup(given);
  EXPECT_FALSE(pair.is_closed());
  { const Wire wire(given); }
  EXPECT_TRUE(pair.is_closed());
  close(copy);
}

TEST(Wire, TakesNoMoreThanTheOtherEndReads) {
  SocketPair pair;
  Wire wire(pair.give());
  std::size_t written = 0;
  for (int i = 0; i < 100'000; ++i) {
    const auto count = wire.write(frame);
    ASSERT_TRUE(count);
    if (*count == 0) break;
    written += *count;
  }
  EXPECT_EQ(wire.write(frame), 0U);
  EXPECT_EQ(pair.read().size(), written);
  EXPECT_EQ(wire.write(frame), frame.size());
}

TEST(Wire, HasABacklogWhileTheOtherEndLeavesFramesLying) {
  SocketPair pair;
  Wire wire(pair.give());
  EXPECT_FALSE(wire.has_backlog());
  (void)wire.write(frame);
  EXPECT_FALSE(wire.has_backlog()) << "one frame is on its way";
  for (int i = 0; i < 5; ++i)
    (void)wire.write(frame);
  EXPECT_TRUE(wire.has_backlog());
  (void)pair.read();
  EXPECT_FALSE(wire.has_backlog());
}

// As Linux' Bluetooth sockets do.
TEST(Wire, HasABacklogOnASocketThatTellsTheRoomItHasLeft) {
  constexpr int room = 10'000;
  int taken = 0;
  const IoctlDouble kernel([&](int, unsigned long request, void* argument) -> std::optional<int> {
    if (request != TIOCOUTQ) return std::nullopt;
    *static_cast<int*>(argument) = room - taken;
    return 0;
  });
  SocketPair pair;
  const Wire wire(pair.give());
  EXPECT_FALSE(wire.has_backlog());
  taken = 768;
  EXPECT_FALSE(wire.has_backlog());
  taken = 3 * 768;
  EXPECT_TRUE(wire.has_backlog());
  taken = room;
  EXPECT_TRUE(wire.has_backlog());
}

}  // namespace
}  // namespace telehug
