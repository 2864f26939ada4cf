// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <thread>

#include "doubles/drawn_screen.hpp"
#include "doubles/fake_portal.hpp"
#include "doubles/private_bus.hpp"
#include "doubles/private_pipewire.hpp"
#include "doubles/temporary_folder.hpp"
#include "screen_portal/portal_grabber.hpp"

namespace telehug {

// Every pixel differs from its neighbours and from those of other shades; the fourth byte is noise.
inline cv::Mat drawn(cv::Size size, int shade) {
  cv::Mat picture(size, CV_8UC4);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x)
      picture.at<cv::Vec4b>(y, x) =
          cv::Vec4b(cv::saturate_cast<uchar>(x % 256), cv::saturate_cast<uchar>(y % 256),
                    cv::saturate_cast<uchar>((x * 7 + y * 13 + shade) % 256), cv::saturate_cast<uchar>((x ^ y) % 256));
  return picture;
}

// How many pixels differ, without their fourth byte.
inline int differing(const cv::Mat& a, const cv::Mat& b) {
  if (a.size() != b.size() || a.type() != b.type()) return -1;
  int count = 0;
  for (int y = 0; y < a.rows; ++y)
    for (int x = 0; x < a.cols; ++x) {
      const auto& p = a.at<cv::Vec4b>(y, x);
      const auto& q = b.at<cv::Vec4b>(y, x);
      count += p[0] != q[0] || p[1] != q[1] || p[2] != q[2] ? 1 : 0;
    }
  return count;
}

// A desktop of the test's own: the test plays its portal and sends its pictures, through a real D-Bus and PipeWire.
class PortalGrabberFixture : public testing::Test {
 protected:
  PortalGrabberFixture() {
    script.node = screen().node();
    script.connect_to_pipewire = [this] { return pipewire.connect(); };
  }

  void plug_in(DrawnScreen::Settings settings) {
    drawn_screen.reset();
    drawn_screen = std::make_unique<DrawnScreen>(pipewire.connect(), settings);
    script.node = drawn_screen->node();
  }
  DrawnScreen& screen() {
    if (!drawn_screen) drawn_screen = std::make_unique<DrawnScreen>(pipewire.connect(), DrawnScreen::Settings{});
    return *drawn_screen;
  }
  FakePortal& portal() {
    if (!played) played = std::make_unique<FakePortal>(bus.address(), script);
    return *played;
  }
  PortalGrabber& grabber() {
    if (!opened) {
      opened = std::make_unique<PortalGrabber>(config(), clock);
      EXPECT_TRUE(opened->open());
    }
    return *opened;
  }
  PortalGrabberConfig config() {
    return {.token_file = token_file,
            .region = region,
            .bus_address = bus.address(),
            .retry_after = retry_after,
            .ask_again_after = ask_again_after};
  }

  // Grabs until it comes out so. Other outcomes before it are all right.
  bool grabs(GrabOutcome wanted, const std::string& because = "") {
    const auto deadline = std::chrono::steady_clock::now() + 20s;
    for (int tries = 1; std::chrono::steady_clock::now() < deadline; ++tries) {
      if (drawn_screen && tries % 10 == 0) drawn_screen->nudge();
      const GrabOutcome outcome = grabber().grab(picture);
      if (outcome == wanted && (because.empty() || grabber().last_error().find(because) != std::string::npos)) {
        return true;
      }
      std::this_thread::sleep_for(2ms);
    }
    ADD_FAILURE() << "the newest error: " << grabber().last_error();
    return false;
  }
  bool shows(const cv::Mat& wanted) {
    return screen().show(wanted) && grabs(GrabOutcome::changed) && differing(picture.bgr, wanted) == 0;
  }
  // When another receiver or another size is still to be agreed on with PipeWire, the first pictures may go by.
  bool shows_in_the_end(const cv::Mat& wanted, cv::Rect seen) {
    const auto deadline = std::chrono::steady_clock::now() + 20s;
    while (std::chrono::steady_clock::now() < deadline) {
      if (screen().size() == wanted.size()) screen().show(wanted);
      if (grabber().grab(picture) == GrabOutcome::changed && differing(picture.bgr, wanted(seen)) == 0) return true;
      std::this_thread::sleep_for(2ms);
    }
    ADD_FAILURE() << "the newest error: " << grabber().last_error();
    return false;
  }
  bool shows_in_the_end(const cv::Mat& wanted) { return shows_in_the_end(wanted, cv::Rect({}, wanted.size())); }
  std::string kept_token() const {
    std::string token;
    std::ifstream(token_file) >> token;
    return token;
  }
  std::string sent_token() {
    const auto words = portal().seen().select;
    const auto found = words.find("restore_token");
    return found == words.end() ? "" : found->second.get<std::string>();
  }

  TemporaryFolder folder;
  std::filesystem::path token_file = folder / "state/screen-token";
  std::optional<cv::Rect> region;
  Duration retry_after = 20ms;
  Duration ask_again_after = 10min;
  SteadyClock clock;
  PrivateBus bus;
  PrivatePipeWire pipewire;
  FakePortal::Script script;
  std::unique_ptr<DrawnScreen> drawn_screen;
  std::unique_ptr<FakePortal> played;
  std::unique_ptr<PortalGrabber> opened;
  ScreenPicture picture;
};

}  // namespace telehug
