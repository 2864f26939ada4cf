// SPDX-License-Identifier: Apache-2.0
#include "integration/screen_portal/portal_grabber_fixture.hpp"

#include <gmock/gmock.h>
#include <spa/buffer/buffer.h>

#include <functional>
#include <limits>
#include <vector>

namespace telehug {
namespace {

class PortalPicturesTest : public PortalGrabberFixture {};

TEST_F(PortalPicturesTest, ShowsExactlyWhatTheDesktopShows) {
  for (const auto format :
       {DrawnScreen::Format::bgrx, DrawnScreen::Format::bgra, DrawnScreen::Format::rgbx, DrawnScreen::Format::rgba}) {
    for (const int padding : {0, 4, 52, 7}) {
      opened.reset();
      played.reset();
      plug_in({.size = {61, 43}, .format = format, .padding_bytes = padding});
      portal();
      grabber();
      for (const int shade : {1, 2, 3}) {
        const cv::Mat wanted = drawn({61, 43}, shade);
        ASSERT_TRUE(screen().show(wanted));
        ASSERT_TRUE(grabs(GrabOutcome::changed));
        EXPECT_EQ(picture.bgr.type(), CV_8UC4);
        EXPECT_EQ(differing(picture.bgr, wanted), 0) << "padding " << padding << ", shade " << shade;
      }
    }
  }
  EXPECT_EQ(picture.origin_px, cv::Point(0, 0));
  EXPECT_EQ(picture.monitor.width_px, 61) << "the portal's own size is another: that of a scaled desktop";
  EXPECT_EQ(picture.monitor.height_px, 43);
  EXPECT_FALSE(picture.in_front.has_value());
  EXPECT_TRUE(grabber().is_live());
}

TEST_F(PortalPicturesTest, SaysUnchangedUntilTheDesktopSendsAnotherPicture) {
  portal();
  grabber();
  ASSERT_TRUE(shows(drawn({64, 48}, 1)));
  const auto before = picture.time;
  EXPECT_EQ(grabber().grab(picture), GrabOutcome::unchanged);
  EXPECT_GT(picture.time, before);
  EXPECT_EQ(differing(picture.bgr, drawn({64, 48}, 1)), 0);
  ASSERT_TRUE(shows(drawn({64, 48}, 2)));
  EXPECT_EQ(grabber().grab(picture), GrabOutcome::unchanged);
}

TEST_F(PortalPicturesTest, ShowsTheNewestOfManyPicturesAndQueuesNone) {
  portal();
  grabber();
  ASSERT_TRUE(shows(drawn({64, 48}, 1)));
  for (int shade = 2; shade < 40; ++shade)
    ASSERT_TRUE(screen().show(drawn({64, 48}, shade))) << "it must go on though nobody looks";
  const cv::Mat newest = drawn({64, 48}, 200);
  const auto deadline = std::chrono::steady_clock::now() + 20s;
  int others = 0;
  while (differing(picture.bgr, newest) != 0 && std::chrono::steady_clock::now() < deadline) {
    ASSERT_TRUE(screen().show(newest));
    if (grabber().grab(picture) == GrabOutcome::changed) ++others;
    std::this_thread::sleep_for(2ms);
  }
  EXPECT_EQ(differing(picture.bgr, newest), 0);
  EXPECT_LT(others, 6) << "as many as PipeWire has buffers at most";
}

TEST_F(PortalPicturesTest, ShowsOnlyTheRegion) {
  region = cv::Rect(40, 30, 1000, 10);
  portal();
  grabber();
  const cv::Mat whole = drawn({64, 48}, 1);
  ASSERT_TRUE(screen().show(whole));
  ASSERT_TRUE(grabs(GrabOutcome::changed));
  EXPECT_EQ(differing(picture.bgr, whole(cv::Rect(40, 30, 24, 10))), 0);
  EXPECT_EQ(picture.origin_px, cv::Point(40, 30));
  EXPECT_EQ(picture.monitor.width_px, 64);
  EXPECT_EQ(picture.monitor.height_px, 48);
}

TEST_F(PortalPicturesTest, SaysThatTheRegionLiesOutsideUntilTheMonitorIsLargeEnough) {
  region = cv::Rect(64, 0, 100, 100);
  portal();
  grabber();
  ASSERT_TRUE(screen().show(drawn({64, 48}, 1)));
  ASSERT_TRUE(grabs(GrabOutcome::lost, "100x100 px at 64,0 lies outside of the monitor (64x48 px)"));
  EXPECT_EQ(grabber().grab(picture), GrabOutcome::lost);
  screen().resize({100, 60});
  const cv::Mat wide = drawn({100, 60}, 2);
  ASSERT_TRUE(shows_in_the_end(wide, cv::Rect(64, 0, 36, 60)));
}

TEST_F(PortalPicturesTest, FollowsAChangeOfResolution) {
  portal();
  grabber();
  ASSERT_TRUE(shows(drawn({64, 48}, 1)));
  for (const cv::Size size : {cv::Size(100, 70), cv::Size(33, 21), cv::Size(64, 48)}) {
    screen().resize(size);
    ASSERT_TRUE(shows_in_the_end(drawn(size, 2)));
    EXPECT_EQ(picture.monitor.width_px, size.width);
    EXPECT_EQ(picture.monitor.height_px, size.height);
  }
}

TEST_F(PortalPicturesTest, IgnoresWhatBringsNothingNew) {
  portal();
  grabber();
  const cv::Mat shown = drawn({64, 48}, 1);
  ASSERT_TRUE(shows(shown));
  const std::vector<std::function<void(spa_chunk&)>> empty{
      [](spa_chunk& chunk) { chunk.size = 0; },
      [](spa_chunk& chunk) { chunk.flags = SPA_CHUNK_FLAG_CORRUPTED; },
  };
  for (const auto& nothing : empty) {
    ASSERT_TRUE(screen().show(drawn({64, 48}, 2), nothing));
    for (int i = 0; i < 25; ++i) {  // more than time enough for it to come
      screen().nudge();
      std::this_thread::sleep_for(1ms);
      ASSERT_EQ(grabber().grab(picture), GrabOutcome::unchanged);
    }
  }
  EXPECT_EQ(differing(picture.bgr, shown), 0);
  EXPECT_TRUE(shows(drawn({64, 48}, 4)));
}

TEST_F(PortalPicturesTest, SaysThatAPictureMakesNoSenseAndGoesOnWithTheNext) {
  portal();
  grabber();
  const std::vector<std::function<void(spa_chunk&)>> lies{
      [](spa_chunk& chunk) { chunk.stride = 4; },
      [](spa_chunk& chunk) { chunk.stride = -256; },
      [](spa_chunk& chunk) { chunk.stride = std::numeric_limits<int>::max(); },
      [](spa_chunk& chunk) { chunk.offset = 1; },
      [](spa_chunk& chunk) { chunk.offset = std::numeric_limits<std::uint32_t>::max(); },
      [](spa_chunk& chunk) { chunk.size = std::numeric_limits<std::uint32_t>::max(); },
      [](spa_chunk& chunk) { chunk.size = 1; },
  };
  for (std::size_t i = 0; i < lies.size(); ++i) {
    ASSERT_TRUE(shows(drawn({64, 48}, 1)));
    ASSERT_TRUE(screen().show(drawn({64, 48}, 2), lies[i]));
    ASSERT_TRUE(grabs(GrabOutcome::lost, "can't be used")) << "lie " << i;
    EXPECT_EQ(grabber().grab(picture), GrabOutcome::lost);
  }
  EXPECT_TRUE(shows(drawn({64, 48}, 3)));
}

TEST_F(PortalPicturesTest, SaysThatNoPictureFlowsWhenTheDesktopStopsSending) {
  portal();
  grabber();
  ASSERT_TRUE(shows(drawn({64, 48}, 1)));
  drawn_screen.reset();
  ASSERT_TRUE(grabs(GrabOutcome::lost, "no picture flows now"));
}

TEST_F(PortalPicturesTest, SaysThatPipeWireCantBeReached) {
  bool reachable = false;
  script.connect_to_pipewire = [&] { return reachable ? pipewire.connect() : -1; };
  portal();
  grabber();
  ASSERT_TRUE(grabs(GrabOutcome::lost, "can't reach PipeWire"));
  portal().rewrite([&](FakePortal::Script&) { reachable = true; });
  EXPECT_TRUE(shows(drawn({64, 48}, 1)));
}

TEST_F(PortalPicturesTest, SaysThatPipeWireEndsTheConnection) {
  script.connect_to_pipewire = [] {
    std::array<int, 2> ends{};
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) return -1;
    ::close(ends[1]);
    return ends[0];
  };
  portal();
  grabber();
  EXPECT_TRUE(grabs(GrabOutcome::lost, "PipeWire, which carries the picture of the screen"));
}

TEST_F(PortalPicturesTest, FindsPipeWireAgainThatWasStartedAnew) {
  portal();
  grabber();
  ASSERT_TRUE(shows(drawn({64, 48}, 1)));
  pipewire.end();
  ASSERT_TRUE(grabs(GrabOutcome::lost, "PipeWire"));
  drawn_screen.reset();
  pipewire.start();
  plug_in({});
  portal().rewrite([this](FakePortal::Script& now) { now.node = script.node; });
  EXPECT_TRUE(shows_in_the_end(drawn({64, 48}, 2)));
}

}  // namespace
}  // namespace telehug
