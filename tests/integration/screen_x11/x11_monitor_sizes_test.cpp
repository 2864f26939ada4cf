// SPDX-License-Identifier: Apache-2.0
#include "screen_x11/x11_monitor_sizes.hpp"

#include <gmock/gmock.h>
#include <xcb/randr.h>

#include <algorithm>
#include <vector>

#include "doubles/monitor_edid.hpp"
#include "doubles/x11_monitors_by_hand.hpp"
#include "doubles/xvfb.hpp"

namespace telehug {
namespace {

class SizesOfMonitors : public testing::Test {
 protected:
  void plug_in(const std::vector<std::uint8_t>& edid) {
    const auto monitors = list_x11_monitors(connection);
    ASSERT_EQ(monitors.size(), 1U);
    ASSERT_EQ(monitors.front().outputs.size(), 1U);
    xcb_randr_change_output_property(connection.get(), monitors.front().outputs.front(), connection.atom("EDID"),
                                     XCB_ATOM_INTEGER, 8, XCB_PROP_MODE_REPLACE,
                                     static_cast<std::uint32_t>(edid.size()), edid.data());
  }

  Xvfb server{"800x600x24"};  // which takes 96 pixels for an inch
  X11Connection connection = *X11Connection::open(server.display());
};

TEST_F(SizesOfMonitors, AreWhatTheMonitorSaysItself) {
  plug_in(monitor_edid({60, 34}, {597, 336}));
  const auto monitors = list_sized_x11_monitors(connection);
  ASSERT_EQ(monitors.size(), 1U);
  EXPECT_EQ(monitors[0].size, (MonitorMm{597, 336}));
  EXPECT_EQ(monitors[0].from, MonitorSizeFrom::edid);
}

TEST_F(SizesOfMonitors, AreTurnedWithTheMonitor) {
  plug_in(monitor_edid({34, 60}, {336, 597}));
  EXPECT_EQ(list_sized_x11_monitors(connection).at(0).size, (MonitorMm{597, 336}));
}

TEST_F(SizesOfMonitors, AreWhatTheServerSaysIfTheMonitorSaysNothingSound) {
  plug_in({1, 2, 3});
  const auto monitors = list_sized_x11_monitors(connection);
  ASSERT_EQ(monitors.size(), 1U);
  EXPECT_EQ(monitors[0].from, MonitorSizeFrom::randr);
  EXPECT_NEAR(monitors[0].size.width_mm, 800 / 96.0 * 25.4, 1);
  EXPECT_NEAR(monitors[0].size.height_mm, 600 / 96.0 * 25.4, 1);
}

TEST_F(SizesOfMonitors, AreNotThoseOfOneOfSeveralParts) {
  plug_in(monitor_edid({60, 34}, {597, 336}));
  X11Client client(server.display());
  set_monitor(client, "left", {0, 0, 400, 600});
  const auto monitors = list_sized_x11_monitors(connection);
  const auto left =
      std::ranges::find_if(monitors, [](const SizedMonitor& sized) { return sized.monitor.name == "left"; });
  ASSERT_NE(left, monitors.end());
  EXPECT_EQ(left->from, MonitorSizeFrom::randr);
  EXPECT_EQ(left->size, (MonitorMm{100, 100}));
}

}  // namespace
}  // namespace telehug
