// SPDX-License-Identifier: Apache-2.0
//
// Displays and monitors that come, go and change.
#include <xcb/randr.h>

#include <cstdlib>
#include <optional>
#include <string>

#include "doubles/x11_monitors_by_hand.hpp"
#include "integration/screen_x11/x11_grabber_fixture.hpp"

namespace telehug {
namespace {

using testing::AllOf;
using testing::HasSubstr;

// Sets a variable of the environment for one test.
class Environment {
 public:
  Environment(std::string name, const char* value) : name_(std::move(name)) {
    if (const char* before = std::getenv(name_.c_str())) before_ = before;
    value != nullptr ? setenv(name_.c_str(), value, 1) : unsetenv(name_.c_str());
  }
  ~Environment() { before_ ? setenv(name_.c_str(), before_->c_str(), 1) : unsetenv(name_.c_str()); }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

 private:
  std::string name_;
  std::optional<std::string> before_;
};

TEST_F(X11GrabberTest, WatchesTheMonitorOfItsName) {
  set_monitor(client, "HDMI-1", {500, 100, 300, 400});
  const auto window = client.open({.place_px = {400, 90, 300, 300}, .colour = 0x102030});
  client.fill(window, {100, 10, 1, 1}, 0xABCDEF);
  open({.monitor = "HDMI-1"});
  ASSERT_EQ(grabber->grab(picture), GrabOutcome::changed);
  EXPECT_EQ(picture.bgr.size(), cv::Size(300, 400));
  EXPECT_EQ(picture.origin_px, cv::Point(0, 0));
  EXPECT_EQ(picture.monitor.width_px, 300);
  EXPECT_EQ(picture.monitor.height_px, 400);
  EXPECT_EQ(colour_at(0, 0), 0xABCDEFU);
  EXPECT_EQ(colour_at(199, 289), 0x102030U);
  EXPECT_EQ(colour_at(200, 290), 0U);
  settle();
  client.fill(window, {50, 50, 50, 50}, 0xFF0000);
  EXPECT_TRUE(stays_unchanged()) << "that is on the other monitor";
}

TEST_F(X11GrabberTest, WatchesThePrimaryMonitorIfNoneIsNamed) {
  set_monitor(client, "DP-1", {500, 100, 200, 100}, true);
  open({});
  ASSERT_EQ(grabber->grab(picture), GrabOutcome::changed);
  EXPECT_EQ(picture.bgr.size(), cv::Size(200, 100));
}

TEST_F(X11GrabberTest, SaysWhichMonitorsThereAreWhenItsOwnIsUnplugged) {
  set_monitor(client, "HDMI-1", {500, 100, 300, 400});
  set_monitor(client, "DP-7", {0, 100, 300, 400});
  open({.monitor = "HDMI-1"});
  ASSERT_EQ(grabber->grab(picture), GrabOutcome::changed);
  delete_monitor(client, "HDMI-1");
  ASSERT_EQ(news(), GrabOutcome::lost);
  EXPECT_THAT(grabber->last_error(), AllOf(HasSubstr("HDMI-1"), HasSubstr("DP-7"), HasSubstr("screen")));
  EXPECT_EQ(grabber->grab(picture), GrabOutcome::lost);
  EXPECT_TRUE(grabber->is_open());

  set_monitor(client, "HDMI-1", {500, 100, 300, 400});
  ASSERT_EQ(grabber->grab(picture), GrabOutcome::changed);
  EXPECT_EQ(picture.bgr.size(), cv::Size(300, 400));
}

TEST_F(X11GrabberTest, TakesTheMonitorsNewPlaceAndSize) {
  set_monitor(client, "HDMI-1", {500, 100, 300, 400});
  client.open({.place_px = {100, 120, 300, 300}, .colour = 0x102030});
  open({.monitor = "HDMI-1"});
  ASSERT_EQ(news(), GrabOutcome::changed);
  settle();
  delete_monitor(client, "HDMI-1");
  set_monitor(client, "HDMI-1", {100, 120, 640, 480});
  ASSERT_TRUE(grab_until([this] { return picture.monitor.width_px == 640; }));
  EXPECT_EQ(picture.bgr.size(), cv::Size(640, 480));
  EXPECT_EQ(colour_at(0, 0), 0x102030U);
}

TEST_F(X11GrabberTest, TakesTheScreensNewResolution) {
  client.open({.place_px = {0, 0, 800, 600}, .colour = 0x102030});
  open({});
  ASSERT_EQ(news(), GrabOutcome::changed);
  settle();
  const std::unique_ptr<xcb_randr_get_screen_resources_reply_t, decltype(&std::free)> resources(
      xcb_randr_get_screen_resources_reply(client.get(), xcb_randr_get_screen_resources(client.get(), client.root()),
                                           nullptr),
      &std::free);
  ASSERT_TRUE(resources);
  const auto crtc = *xcb_randr_get_screen_resources_crtcs(resources.get());
  const auto output = *xcb_randr_get_screen_resources_outputs(resources.get());
  xcb_randr_mode_info_t info{};
  info.width = 640;
  info.height = 480;
  const std::string name = "640x480";
  info.name_len = static_cast<std::uint16_t>(name.size());
  const std::unique_ptr<xcb_randr_create_mode_reply_t, decltype(&std::free)> mode(
      xcb_randr_create_mode_reply(
          client.get(), xcb_randr_create_mode(client.get(), client.root(), info, info.name_len, name.data()), nullptr),
      &std::free);
  ASSERT_TRUE(mode);
  xcb_randr_add_output_mode(client.get(), output, mode->mode);
  std::free(xcb_randr_set_crtc_config_reply(
      client.get(),
      xcb_randr_set_crtc_config(client.get(), crtc, XCB_CURRENT_TIME, XCB_CURRENT_TIME, 0, 0, mode->mode,
                                XCB_RANDR_ROTATION_ROTATE_0, 1, &output),
      nullptr));
  xcb_randr_set_screen_size(client.get(), client.root(), 640, 480, 160, 120);
  client.sync();
  ASSERT_TRUE(grab_until([this] { return picture.monitor.width_px == 640; }));
  EXPECT_EQ(picture.bgr.size(), cv::Size(640, 480));
  EXPECT_TRUE(shows_only(0x102030, {0, 0, 640, 480}));
}

TEST_F(X11GrabberTest, JoinsTheDisplayAgainWhenItsServerIsBack) {
  // A number that no other server takes meanwhile.
  Xvfb mortal("320x200x24", {":" + std::to_string(100 + getpid() % 50000)});
  X11Grabber watching({.display = mortal.display()}, clock);
  ASSERT_TRUE(watching.open());
  ASSERT_EQ(watching.grab(picture), GrabOutcome::changed);
  clock.advance(10s);
  mortal.stop();
  ASSERT_EQ(watching.grab(picture), GrabOutcome::lost);
  EXPECT_THAT(watching.last_error(), AllOf(HasSubstr(mortal.display()), HasSubstr("gone")));
  clock.advance(1s);
  ASSERT_EQ(watching.grab(picture), GrabOutcome::lost);
  EXPECT_THAT(watching.last_error(), HasSubstr("can't be reached"));

  mortal.start();
  clock.advance(999ms);
  EXPECT_EQ(watching.grab(picture), GrabOutcome::lost) << "looked for once a second";
  clock.advance(1ms);
  ASSERT_EQ(watching.grab(picture), GrabOutcome::changed);
  EXPECT_EQ(picture.bgr.size(), cv::Size(320, 200));
}

TEST_F(X11GrabberTest, SaysThatThereIsNoDisplay) {
  const Environment none("DISPLAY", nullptr);
  X11Grabber without({}, clock);
  const Status opened = without.open();
  ASSERT_FALSE(opened);
  EXPECT_THAT(opened.error().message, HasSubstr("DISPLAY is not set"));
  EXPECT_FALSE(without.is_open());
  EXPECT_EQ(without.grab(picture), GrabOutcome::lost);
  EXPECT_THAT(without.last_error(), HasSubstr("not open"));

  X11Grabber misspelt({.display = "here"}, clock);
  const Status refused = misspelt.open();
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, AllOf(HasSubstr("here"), HasSubstr("can't be reached")));
}

TEST_F(X11GrabberTest, TakesTheDisplayOfTheEnvironment) {
  const Environment own("DISPLAY", server.display().c_str());
  X11Grabber watching({}, clock);
  ASSERT_TRUE(watching.open());
  EXPECT_EQ(watching.grab(picture), GrabOutcome::changed);
  watching.close();
  EXPECT_FALSE(watching.is_open());
  EXPECT_EQ(watching.grab(picture), GrabOutcome::lost);
  ASSERT_TRUE(watching.open());
  EXPECT_EQ(watching.grab(picture), GrabOutcome::changed);
}

TEST_F(X11GrabberTest, SaysThatABlackScreenIsWaylands) {
  const Environment wayland("WAYLAND_DISPLAY", "wayland-0");
  open({});
  EXPECT_EQ(grabber->grab(picture), GrabOutcome::changed);
  while (grabber->grab(picture) != GrabOutcome::lost) {
  }
  EXPECT_THAT(grabber->last_error(), AllOf(HasSubstr("Wayland"), HasSubstr("body_map.source to portal")));
  EXPECT_EQ(grabber->grab(picture), GrabOutcome::lost);

  client.open({.place_px = {799, 599, 1, 1}, .colour = 0x000001});
  ASSERT_EQ(grabber->grab(picture), GrabOutcome::changed);
  EXPECT_EQ(colour_at(799, 599), 1U);
}

TEST_F(X11GrabberTest, TakesABlackScreenOfAnX11SessionAsItIs) {
  const Environment no_wayland("WAYLAND_DISPLAY", nullptr);
  open({});
  ASSERT_EQ(grabber->grab(picture), GrabOutcome::changed);
  settle();
  EXPECT_TRUE(stays_unchanged());
}

}  // namespace
}  // namespace telehug
