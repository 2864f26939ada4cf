// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gmock/gmock.h>

#include <chrono>
#include <cstdint>
#include <memory>
#include <thread>
#include <utility>

#include "doubles/fake_clock.hpp"
#include "doubles/x11_client.hpp"
#include "doubles/xvfb.hpp"
#include "screen_x11/x11_grabber.hpp"

namespace telehug {

// An X server of 800x600 px with a program on it, and a grabber that watches it.
class X11GrabberTest : public testing::Test {
 protected:
  void open(X11GrabberConfig config) {
    config.display = server.display();
    grabber = std::make_unique<X11Grabber>(std::move(config), clock);
    const Status opened = grabber->open();
    ASSERT_TRUE(opened) << opened.error().message;
  }

  // What the next grab that has news returns. The server's news travel on their own way: a test that has just drawn
  // something may be ahead of them.
  GrabOutcome news() {
    const auto end = std::chrono::steady_clock::now() + 20s;
    GrabOutcome outcome = grabber->grab(picture);
    while (outcome == GrabOutcome::unchanged && std::chrono::steady_clock::now() < end) {
      std::this_thread::sleep_for(1ms);
      outcome = grabber->grab(picture);
    }
    return outcome;
  }

  // Grabs until `picture` is as wanted.
  template <typename Wanted>
  bool grab_until(Wanted wanted) {
    const auto end = std::chrono::steady_clock::now() + 20s;
    do {
      if (grabber->grab(picture) != GrabOutcome::lost && wanted()) return true;
      std::this_thread::sleep_for(1ms);
    } while (std::chrono::steady_clock::now() < end);
    return false;
  }
  bool comes_in_front() {
    return grab_until([this] { return picture.in_front == true; });
  }
  bool goes_behind() {
    return grab_until([this] { return picture.in_front == false; });
  }

  // Grabs until nothing that the server still had to tell is left.
  void settle() {
    for (int quiet = 0; quiet < 20;) {
      client.sync();
      quiet = grabber->grab(picture) == GrabOutcome::unchanged ? quiet + 1 : 0;
    }
  }
  // The server has answered many times since: its news would have come.
  bool stays_unchanged() {
    for (int i = 0; i < 20; ++i) {
      client.sync();
      if (grabber->grab(picture) != GrabOutcome::unchanged) return false;
    }
    return true;
  }

  // 0xRRGGBB of a place in the picture.
  [[nodiscard]] std::uint32_t colour_at(int x, int y) const {
    const auto& pixel = picture.bgr.at<cv::Vec4b>(y, x);
    return static_cast<std::uint32_t>(pixel[2] << 16 | pixel[1] << 8 | pixel[0]);
  }
  // Does the picture show this colour all over `area_px`, and up to its edge?
  [[nodiscard]] bool shows_only(std::uint32_t colour, const cv::Rect& area_px) const {
    for (int y = area_px.y; y < area_px.br().y; ++y) {
      for (int x = area_px.x; x < area_px.br().x; ++x) {
        if (colour_at(x, y) != colour) return false;
      }
    }
    return true;
  }

  Xvfb server;
  X11Client client{server.display()};
  FakeClock clock;
  std::unique_ptr<X11Grabber> grabber;
  ScreenPicture picture;
};

}  // namespace telehug
