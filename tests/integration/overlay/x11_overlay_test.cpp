// SPDX-License-Identifier: Apache-2.0
#include "overlay/x11_overlay.hpp"

#include <gmock/gmock.h>
#include <unistd.h>
#include <xcb/xtest.h>

#include <chrono>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <thread>

#include "doubles/fake_clock.hpp"
#include "doubles/x11_client.hpp"
#include "doubles/x11_monitors_by_hand.hpp"
#include "doubles/xvfb.hpp"
#include "overlay/outline.hpp"
#include "screen_x11/x11_grabber.hpp"

namespace telehug {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr std::uint32_t red = 0xE53935;
constexpr std::uint32_t green = 0x43A047;
constexpr std::uint32_t pink = 0xEC407A;
const cv::Rect screen_px(0, 0, 800, 600);

class X11OverlayTest : public testing::Test {
 protected:
  X11OverlayTest() { background = client.open({.place_px = screen_px, .colour = 0x102030}); }

  // The screen with lines on it, and nothing else.
  [[nodiscard]] static cv::Mat1i screen_with(const std::vector<cv::Rect>& lines_px, std::uint32_t rgb) {
    cv::Mat1i screen(screen_px.size(), 0x102030);
    for (const cv::Rect& line : lines_px)
      screen(line) = static_cast<int>(rgb);
    return screen;
  }
  // The overlay's requests travel on their own way: the screen is looked at until it is as wanted.
  template <typename Holds>
  bool comes_true(Holds holds) {
    const auto end = std::chrono::steady_clock::now() + 20s;
    do {
      if (holds()) return true;
      std::this_thread::sleep_for(1ms);
    } while (std::chrono::steady_clock::now() < end);
    return false;
  }
  bool shows(const std::vector<cv::Rect>& lines_px, std::uint32_t rgb) {
    const cv::Mat1i wanted = screen_with(lines_px, rgb);
    return comes_true([&] { return cv::countNonZero(client.screenshot(screen_px) != wanted) == 0; });
  }

  Xvfb server;
  X11Client client{server.display()};
  xcb_window_t background = 0;
  FakeClock clock;
  X11Overlay overlay{{.display = server.display()}, clock};
};

TEST_F(X11OverlayTest, OutlinesTheBoxAndNothingElse) {
  const cv::Rect box(100, 50, 80, 60);
  overlay.show(box, OverlayState::touched);
  EXPECT_TRUE(shows({}, red)) << "it isn't open yet";
  const Status opened = overlay.open();
  ASSERT_TRUE(opened) << opened.error().message;
  EXPECT_TRUE(shows({}, red)) << "nothing until it is asked for";

  overlay.show(box, OverlayState::touched);
  EXPECT_TRUE(shows({{100, 50, 80, 3}, {100, 107, 80, 3}, {100, 50, 3, 60}, {177, 50, 3, 60}}, red));
  overlay.show(box, OverlayState::felt);
  EXPECT_TRUE(shows({{100, 50, 80, 6}, {100, 104, 80, 6}, {100, 50, 6, 60}, {174, 50, 6, 60}}, green));
  overlay.show(box, OverlayState::touched);
  EXPECT_TRUE(shows(make_outline(box, 3, screen_px), red));
  overlay.show(box + cv::Point(40, 30), OverlayState::touched);
  EXPECT_TRUE(shows(make_outline(box + cv::Point(40, 30), 3, screen_px), red));
  overlay.hide();
  EXPECT_TRUE(shows({}, red));
  overlay.show(box, OverlayState::felt);
  EXPECT_TRUE(shows(make_outline(box, 6, screen_px), green));
  overlay.show(box, OverlayState::hugged);
  EXPECT_TRUE(shows(make_outline(box, 6, screen_px), pink));
  overlay.close();
  EXPECT_TRUE(shows({}, red));
  EXPECT_EQ(overlay.last_error(), "");
}

TEST_F(X11OverlayTest, CutsTheLinesToItsMonitor) {
  set_monitor(client, "HDMI-1", {500, 100, 200, 300});
  X11Overlay other({.display = server.display(), .monitor = "HDMI-1"}, clock);
  ASSERT_TRUE(other.open());
  other.show({150, -20, 100, 100}, OverlayState::touched);
  EXPECT_TRUE(shows({{650, 177, 50, 3}, {650, 100, 3, 80}}, red));
  EXPECT_THAT(other.areas(), testing::UnorderedElementsAre(cv::Rect(150, 74, 50, 6), cv::Rect(150, 0, 6, 74)));
  other.show({300, 0, 50, 50}, OverlayState::touched);
  EXPECT_TRUE(shows({}, red)) << "all of it lies outside";
  EXPECT_TRUE(other.areas().empty());
}

TEST_F(X11OverlayTest, WaitsForItsMonitor) {
  X11Overlay other({.display = server.display(), .monitor = "HDMI-1"}, clock);
  ASSERT_TRUE(other.open());
  other.show({10, 10, 50, 50}, OverlayState::touched);
  EXPECT_THAT(other.last_error(), AllOf(HasSubstr("no monitor HDMI-1"), HasSubstr("screen")));
  set_monitor(client, "HDMI-1", {500, 100, 200, 300});
  other.show({10, 10, 50, 50}, OverlayState::touched);
  EXPECT_EQ(other.last_error(), "");
  EXPECT_TRUE(shows(make_outline({510, 110, 50, 50}, 3, screen_px), red));

  delete_monitor(client, "HDMI-1");
  EXPECT_TRUE(comes_true([&] {
    other.show({10, 10, 50, 50}, OverlayState::touched);
    return !other.last_error().empty();
  }));
  EXPECT_TRUE(shows({}, red));
}

TEST_F(X11OverlayTest, LetsClicksThrough) {
  const std::uint32_t buttons = XCB_EVENT_MASK_BUTTON_PRESS;
  xcb_change_window_attributes(client.get(), background, XCB_CW_EVENT_MASK, &buttons);
  client.sync();
  ASSERT_TRUE(overlay.open());
  overlay.show({100, 50, 80, 60}, OverlayState::touched);
  ASSERT_TRUE(shows(make_outline({100, 50, 80, 60}, 3, screen_px), red));
  xcb_test_fake_input(client.get(), XCB_MOTION_NOTIFY, 0, XCB_CURRENT_TIME, client.root(), 101, 51, 0);
  xcb_test_fake_input(client.get(), XCB_BUTTON_PRESS, 1, XCB_CURRENT_TIME, client.root(), 0, 0, 0);
  xcb_test_fake_input(client.get(), XCB_BUTTON_RELEASE, 1, XCB_CURRENT_TIME, client.root(), 0, 0, 0);
  client.sync();
  std::optional<cv::Point> clicked;
  EXPECT_TRUE(comes_true([&] {
    XcbOwned<xcb_generic_event_t> event(xcb_poll_for_event(client.get()));
    if (event && is_x11_event(*event, XCB_BUTTON_PRESS)) {
      const auto& press = reinterpret_cast<const xcb_button_press_event_t&>(*event);
      clicked = cv::Point(press.root_x, press.root_y);
    }
    return clicked.has_value();
  }));
  EXPECT_EQ(clicked, cv::Point(101, 51));
}

TEST_F(X11OverlayTest, ComesBackAboveAWindowThatWasPutOverIt) {
  const cv::Rect box(100, 50, 80, 60);
  ASSERT_TRUE(overlay.open());
  overlay.show(box, OverlayState::touched);
  ASSERT_TRUE(shows(make_outline(box, 3, screen_px), red));
  client.open({.place_px = screen_px, .colour = 0x102030, .override_redirect = true});
  ASSERT_TRUE(shows({}, red));
  EXPECT_TRUE(comes_true([&] {
    clock.advance(1s);
    overlay.show(box, OverlayState::touched);
    return client.shown_at(box.tl()) == red;
  }));
}

TEST_F(X11OverlayTest, DrawsNothingWhileNothingChanges) {
  X11Grabber grabber({.display = server.display()}, clock);
  ASSERT_TRUE(grabber.open());
  ASSERT_TRUE(overlay.open());
  const cv::Rect box(100, 50, 80, 60);
  overlay.show(box, OverlayState::touched);
  ASSERT_TRUE(shows(make_outline(box, 3, screen_px), red));
  ScreenPicture picture;
  for (int quiet = 0; quiet < 20;) {
    client.sync();
    quiet = grabber.grab(picture) == GrabOutcome::unchanged ? quiet + 1 : 0;
  }
  for (int i = 0; i < 20; ++i) {
    clock.advance(1s);
    overlay.show(box, OverlayState::touched);
    client.sync();
    ASSERT_EQ(grabber.grab(picture), GrabOutcome::unchanged);
  }
}

TEST_F(X11OverlayTest, IsNotSeenByAGrabberThatLeavesItOut) {
  X11Grabber grabber({.display = server.display()}, clock);
  ASSERT_TRUE(grabber.open());
  ScreenPicture picture;
  for (int quiet = 0; quiet < 20;) {
    client.sync();
    quiet = grabber.grab(picture) == GrabOutcome::unchanged ? quiet + 1 : 0;
  }
  const cv::Mat before = picture.bgr.clone();
  ASSERT_TRUE(overlay.open());
  EXPECT_TRUE(overlay.areas().empty());
  const cv::Rect box(100, 50, 80, 60);
  for (const OverlayState state : {OverlayState::touched, OverlayState::felt}) {
    overlay.show(box, state);
    grabber.leave_out(overlay.areas());
    ASSERT_TRUE(shows(make_outline(box, state == OverlayState::felt ? 6 : 3, screen_px),
                      state == OverlayState::felt ? green : red));
    for (int i = 0; i < 20; ++i) {
      client.sync();
      ASSERT_EQ(grabber.grab(picture), GrabOutcome::unchanged);
    }
  }
  client.fill(background, {400, 300, 1, 1}, 0xFFFFFF);
  ASSERT_TRUE(comes_true([&] { return grabber.grab(picture) == GrabOutcome::changed; }));
  cv::Mat difference;
  cv::absdiff(before, picture.bgr, difference);
  difference.at<cv::Vec4b>(300, 400) = {};
  EXPECT_EQ(cv::countNonZero(difference.reshape(1)), 0) << "all as before but for the new point";

  overlay.hide();
  EXPECT_TRUE(overlay.areas().empty());
  grabber.leave_out(overlay.areas());
  ASSERT_TRUE(comes_true([&] { return grabber.grab(picture) == GrabOutcome::changed; }));
}

TEST_F(X11OverlayTest, CoversNothingOfAPinnedWindow) {
  client.open({.place_px = {100, 50, 80, 60}, .title = "chat"});
  X11Grabber grabber({.display = server.display(), .window = "chat"}, clock);
  ASSERT_TRUE(grabber.open());
  ASSERT_TRUE(overlay.open());
  overlay.show({100, 50, 80, 60}, OverlayState::felt);
  ASSERT_TRUE(comes_true([&] { return client.shown_at({100, 50}) == green; }));
  ScreenPicture picture;
  ASSERT_EQ(grabber.grab(picture), GrabOutcome::changed);
  EXPECT_EQ(picture.in_front, true);
  EXPECT_EQ(picture.bgr.at<cv::Vec4b>(0, 0)[0], 0xFF) << "the window's own white";
}

TEST_F(X11OverlayTest, ComesBackWithItsServer) {
  // A number that no other server takes meanwhile.
  Xvfb mortal("800x600x24", {":" + std::to_string(100 + getpid() % 50000)});
  X11Overlay other({.display = mortal.display()}, clock);
  ASSERT_TRUE(other.open());
  const cv::Rect box(100, 50, 80, 60);
  other.show(box, OverlayState::touched);
  EXPECT_FALSE(other.areas().empty());
  clock.advance(10s);
  mortal.stop();
  other.show(box, OverlayState::touched);
  EXPECT_THAT(other.last_error(), AllOf(HasSubstr(mortal.display()), HasSubstr("gone")));
  EXPECT_TRUE(other.areas().empty()) << "nothing is shown";
  clock.advance(1s);
  other.show(box, OverlayState::touched);
  EXPECT_THAT(other.last_error(), HasSubstr("can't be reached"));

  mortal.start();
  X11Client looking(mortal.display());
  clock.advance(1s);
  other.show(box, OverlayState::touched);
  EXPECT_EQ(other.last_error(), "");
  EXPECT_TRUE(comes_true([&] { return looking.shown_at(box.tl()) == red; }));
}

TEST_F(X11OverlayTest, SaysWhyItCantBeOpened) {
  X11Overlay other({.display = "here"}, clock);
  const Status opened = other.open();
  ASSERT_FALSE(opened);
  EXPECT_THAT(opened.error().message, HasSubstr("can't be reached"));
  other.show({1, 1, 5, 5}, OverlayState::touched);
  EXPECT_TRUE(other.areas().empty());
}

}  // namespace
}  // namespace telehug
