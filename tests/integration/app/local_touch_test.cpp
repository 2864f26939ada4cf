// SPDX-License-Identifier: Apache-2.0
//
// Touches for this PC's own programs, from the real daemon, without anybody on the other side.
#include <gtest/gtest.h>
#include <unistd.h>

#include "doubles/tuio_listener.hpp"
#include "integration/app/running_pair.hpp"

namespace telehug {
namespace {

TEST(LocalUseOfTheTouch, GoesOnWithoutAPeerAndPastAnOutputThatFails) {
  if (access("/dev/uinput", W_OK) == 0) GTEST_SKIP() << "here nothing would fail: /dev/uinput is writable";
  TuioListener listener;
  RunningPair pair;
  pair.calibrate("replay:" TELEHUG_FIXTURES "/rig2");
  pair.active_settings = {"local_touch.uinput=true", "local_touch.tuio=true",
                          "local_touch.tuio_port=" + std::to_string(listener.port())};
  pair.start_active();
  const auto somebody_touches = [&] {
    const auto bundles = listener.bundles();
    return !bundles.empty() && !bundles.back().alive.empty();
  };
  EXPECT_TRUE(eventually(somebody_touches)) << pair.logs();
  EXPECT_TRUE(eventually([&] { return pair.complains(Side::active, "/dev/uinput"); })) << pair.logs();
  EXPECT_TRUE(eventually([&] { return pair.camera_open(); })) << pair.logs();
  EXPECT_EQ(pair.status(Side::active).at("camera").at("why"), "this PC uses the touches");
  EXPECT_EQ(pair.counter(Side::active, "events_published"), 0U);

  EXPECT_EQ(pair.telehug("stop", Side::active).code, 0);
  EXPECT_TRUE(eventually([&] { return !pair.camera_open(); })) << pair.logs();
}

// The camera sees this picture from now on.
void show(const RunningPair& pair, const char* picture) {
  const auto shown = pair.folder / "held" / "1.jpg";
  std::filesystem::create_symlink(std::string(TELEHUG_FIXTURES "/rig2/") + picture, pair.folder / "next");
  std::filesystem::rename(pair.folder / "next", shown);
}

TEST(LocalUseOfTheTouch, LeavesAFingerThatCameWhileSendingWasOffOnNobodyUntilItIsLifted) {
  TuioListener listener;
  RunningPair pair;
  pair.calibrate("replay:" TELEHUG_FIXTURES "/rig2");
  pair.active_settings = {"local_touch.tuio=true", "local_touch.tuio_port=" + std::to_string(listener.port())};
  pair.start_jacket();
  pair.start_passive();
  pair.start_active();
  const auto rests_here = [&] {
    const auto bundles = listener.bundles();
    return !bundles.empty() && !bundles.back().alive.empty();
  };
  const auto send = [&](const char* mode) {
    return pair.run({TELEHUG_BIN "/telehug", "send", mode, "--socket", pair.socket(Side::active).string()}).code;
  };
  const auto lift = [&] {
    show(pair, "background.jpg");
    return eventually([&] { return !rests_here() && !pair.felt(); });
  };
  ASSERT_TRUE(eventually([&] { return pair.felt(); })) << pair.logs();
  ASSERT_TRUE(lift()) << pair.logs();
  ASSERT_EQ(send("off"), 0);
  show(pair, "sequence/012.jpg");
  ASSERT_TRUE(eventually(rests_here)) << pair.logs();
  ASSERT_EQ(send("on"), 0);
  const std::uint64_t end = pair.counter(Side::active, "frames") + 60;
  ASSERT_TRUE(eventually([&] { return pair.counter(Side::active, "frames") >= end || pair.felt(); }));
  EXPECT_FALSE(pair.felt());
  EXPECT_TRUE(rests_here());
  ASSERT_TRUE(lift());
  show(pair, "sequence/012.jpg");
  EXPECT_TRUE(eventually([&] { return pair.felt(); })) << pair.logs();
}

}  // namespace
}  // namespace telehug
