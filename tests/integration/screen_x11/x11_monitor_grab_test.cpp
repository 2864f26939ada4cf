// SPDX-License-Identifier: Apache-2.0
#include "integration/screen_x11/x11_grabber_fixture.hpp"

namespace telehug {
namespace {

using testing::AllOf;
using testing::HasSubstr;

TEST_F(X11GrabberTest, ShowsTheScreensPixelsWhereTheyAre) {
  const auto window = client.open({.place_px = {100, 50, 200, 150}, .colour = 0x102030});
  client.fill(window, {10, 20, 30, 40}, 0xFF8001);
  open({});
  ASSERT_EQ(grabber->grab(picture), GrabOutcome::changed);
  ASSERT_EQ(picture.bgr.type(), CV_8UC4);
  ASSERT_EQ(picture.bgr.size(), cv::Size(800, 600));
  EXPECT_EQ(picture.origin_px, cv::Point(0, 0));
  EXPECT_EQ(picture.monitor.width_px, 800);
  EXPECT_EQ(picture.monitor.height_px, 600);
  EXPECT_EQ(picture.time, clock.now());
  EXPECT_EQ(picture.in_front, std::nullopt) << "no window is pinned";
  EXPECT_TRUE(shows_only(0xFF8001, {110, 70, 30, 40}));
  EXPECT_EQ(colour_at(109, 70), 0x102030U);
  EXPECT_EQ(colour_at(110, 69), 0x102030U);
  EXPECT_EQ(colour_at(140, 109), 0x102030U);
  EXPECT_EQ(colour_at(100, 50), 0x102030U);
  EXPECT_EQ(colour_at(299, 199), 0x102030U);
  EXPECT_EQ(colour_at(99, 50), 0U);
  EXPECT_EQ(colour_at(300, 199), 0U);
  EXPECT_TRUE(grabber->is_live());
}

TEST_F(X11GrabberTest, FillsTheSamePixelsAnewInsteadOfCopying) {
  const auto window = client.open({});
  open({});
  ASSERT_EQ(grabber->grab(picture), GrabOutcome::changed);
  const auto* first = picture.bgr.data;
  settle();
  client.fill(window, {0, 0, 10, 10}, 0x123456);
  ASSERT_EQ(news(), GrabOutcome::changed);
  EXPECT_EQ(picture.bgr.data, first);
}

TEST_F(X11GrabberTest, IsUnchangedUntilSomethingIsDrawn) {
  const auto window = client.open({.colour = 0x102030});
  open({});
  ASSERT_EQ(grabber->grab(picture), GrabOutcome::changed);
  settle();
  clock.advance(125ms);
  ASSERT_EQ(grabber->grab(picture), GrabOutcome::unchanged);
  EXPECT_EQ(picture.time, clock.now());
  EXPECT_EQ(colour_at(5, 5), 0x102030U);

  for (const std::uint32_t colour : {0xFF0000U, 0x00FF00U, 0x0000FFU}) {
    client.fill(window, {5, 5, 1, 1}, colour);
    ASSERT_EQ(news(), GrabOutcome::changed);
    EXPECT_EQ(colour_at(5, 5), colour);
    EXPECT_TRUE(stays_unchanged());
  }
}

TEST_F(X11GrabberTest, LooksOnlyAtItsRegion) {
  const auto window = client.open({.place_px = {0, 0, 800, 600}, .colour = 0x102030});
  client.fill(window, {300, 200, 1, 1}, 0xABCDEF);
  open({.region = cv::Rect(300, 200, 100, 50)});
  ASSERT_EQ(grabber->grab(picture), GrabOutcome::changed);
  EXPECT_EQ(picture.bgr.size(), cv::Size(100, 50));
  EXPECT_EQ(picture.origin_px, cv::Point(300, 200));
  EXPECT_EQ(picture.monitor.width_px, 800);
  EXPECT_EQ(colour_at(0, 0), 0xABCDEFU);
  settle();

  client.fill(window, {200, 200, 100, 50}, 0xFF0000);
  EXPECT_TRUE(stays_unchanged()) << "drawn beside it, up to its edge";
  client.fill(window, {0, 0, 10, 10}, 0xFF0000);
  client.fill(window, {700, 500, 10, 10}, 0xFF0000);
  EXPECT_TRUE(stays_unchanged()) << "drawn on both sides of it";

  client.fill(window, {399, 249, 10, 10}, 0xFF0000);
  ASSERT_EQ(news(), GrabOutcome::changed);
  EXPECT_EQ(colour_at(99, 49), 0xFF0000U);
}

TEST_F(X11GrabberTest, CutsItsRegionToTheMonitor) {
  open({.region = cv::Rect(700, 500, 2'000'000'000, 2'000'000'000)});
  ASSERT_EQ(grabber->grab(picture), GrabOutcome::changed);
  EXPECT_EQ(picture.bgr.size(), cv::Size(100, 100));

  open({.region = cv::Rect(800, 0, 10, 10)});
  EXPECT_EQ(grabber->grab(picture), GrabOutcome::lost);
  EXPECT_THAT(grabber->last_error(), AllOf(HasSubstr("region"), HasSubstr("800x600"), HasSubstr("correct")));
}

TEST_F(X11GrabberTest, PassesOverWhatIsDrawnInLeftOutAreas) {
  const auto window = client.open({.place_px = {0, 0, 800, 600}, .colour = 0x102030});
  open({});
  ASSERT_EQ(news(), GrabOutcome::changed);
  settle();

  grabber->leave_out({{100, 100, 50, 10}, {100, 110, 20, 30}});
  client.fill(window, {100, 100, 50, 10}, 0xFF0000);
  client.fill(window, {105, 105, 10, 20}, 0xFF0000);
  EXPECT_TRUE(stays_unchanged()) << "within one of them, and across both";

  client.fill(window, {145, 105, 10, 10}, 0x00FF00);
  ASSERT_EQ(news(), GrabOutcome::changed) << "a part of that is outside";
  EXPECT_EQ(colour_at(150, 110), 0x00FF00U);
  EXPECT_TRUE(shows_only(0x102030, {100, 100, 50, 10})) << "what was there before";
  EXPECT_TRUE(shows_only(0x102030, {100, 110, 20, 30}));
  settle();

  grabber->leave_out({});
  ASSERT_EQ(news(), GrabOutcome::changed) << "it counts again";
  EXPECT_EQ(colour_at(100, 100), 0xFF0000U);
  EXPECT_EQ(colour_at(110, 120), 0xFF0000U);
  EXPECT_TRUE(stays_unchanged());
}

TEST_F(X11GrabberTest, KeepsWhatWasShownWhenLeftOutAreasMove) {
  const auto window = client.open({.place_px = {0, 0, 800, 600}, .colour = 0x102030});
  open({.region = cv::Rect(50, 50, 500, 500)});
  ASSERT_EQ(news(), GrabOutcome::changed);
  settle();
  grabber->leave_out({{100, 100, 10, 10}});
  client.fill(window, {100, 100, 10, 10}, 0xFF0000);
  ASSERT_TRUE(stays_unchanged());
  client.fill(window, {100, 100, 10, 10}, 0x102030);
  grabber->leave_out({{200, 100, 10, 10}});
  client.fill(window, {200, 100, 10, 10}, 0xFF0000);
  ASSERT_EQ(news(), GrabOutcome::changed);
  EXPECT_TRUE(shows_only(0x102030, {0, 0, 500, 500}));
}

TEST(X11GrabberAtAServer, WithoutSharedMemoryReadsThroughTheConnection) {
  const Xvfb server("320x200x24", {"-extension", "MIT-SHM"});
  X11Client client(server.display());
  const auto window = client.open({.place_px = {10, 20, 30, 40}, .colour = 0x112233});
  FakeClock clock;
  X11Grabber grabber({.display = server.display()}, clock);
  ASSERT_TRUE(grabber.open());
  ScreenPicture picture;
  ASSERT_EQ(grabber.grab(picture), GrabOutcome::changed);
  ASSERT_EQ(picture.bgr.size(), cv::Size(320, 200));
  EXPECT_EQ(picture.bgr.at<cv::Vec4b>(20, 10)[0], 0x33);
  EXPECT_EQ(picture.bgr.at<cv::Vec4b>(59, 39)[2], 0x11);
  EXPECT_EQ(picture.bgr.at<cv::Vec4b>(60, 39)[2], 0);
  client.fill(window, {0, 0, 1, 1}, 0x445566);
  grabber.leave_out({{11, 20, 5, 5}});
  while (grabber.grab(picture) == GrabOutcome::unchanged) {
    client.sync();
  }
  EXPECT_EQ(picture.bgr.at<cv::Vec4b>(20, 10)[0], 0x66);
}

TEST(X11GrabberAtAServer, RefusesColoursThatItCantRead) {
  const Xvfb server("320x200x16");
  FakeClock clock;
  X11Grabber grabber({.display = server.display()}, clock);
  const Status opened = grabber.open();
  ASSERT_FALSE(opened);
  EXPECT_THAT(opened.error().message, AllOf(HasSubstr(server.display()), HasSubstr("depth 16"), HasSubstr("24")));
}

TEST(X11GrabberAtAServer, NamesTheExtensionThatIsMissing) {
  const Xvfb server("320x200x24", {"-extension", "Composite"});
  FakeClock clock;
  X11Grabber grabber({.display = server.display()}, clock);
  const Status opened = grabber.open();
  ASSERT_FALSE(opened);
  EXPECT_THAT(opened.error().message, HasSubstr("Composite"));
}

}  // namespace
}  // namespace telehug
