// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <opencv2/core/mat.hpp>
#include <string>
#include <thread>

#include "common/clock.hpp"
#include "doubles/x11_client.hpp"

namespace telehug {

// A window as large as the screen whose picture is drawn anew 25 times a second, a little lighter or darker each time,
// until it is told to stand still.
class MovingChat {
 public:
  MovingChat(const std::string& display, cv::Mat bgrx) : client_(display), picture_(std::move(bgrx)) {
    window_ = client_.open({.place_px = {0, 0, picture_.cols, picture_.rows}, .title = "chat"});
    client_.draw(window_, {0, 0}, picture_);
    thread_ = std::thread([this] { move(); });
  }
  ~MovingChat() {
    ending_ = true;
    thread_.join();
  }

  void stand_still(bool still) { still_ = still; }

 private:
  void move() {
    const cv::Mat shades[] = {picture_, picture_ + cv::Scalar::all(8), picture_ + cv::Scalar::all(16)};
    for (std::size_t i = 0; !ending_; ++i) {
      if (!still_) client_.draw(window_, {0, 0}, shades[i % 3]);
      std::this_thread::sleep_for(40ms);
    }
  }

  X11Client client_;
  cv::Mat picture_;
  xcb_window_t window_ = 0;
  std::atomic<bool> still_ = false;
  std::atomic<bool> ending_ = false;
  std::thread thread_;
};

}  // namespace telehug
