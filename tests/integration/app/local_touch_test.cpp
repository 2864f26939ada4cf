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

}  // namespace
}  // namespace telehug
