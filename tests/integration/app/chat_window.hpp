// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <string>
#include <thread>

#include "doubles/x11_client.hpp"
#include "pictures/picture_file.hpp"

namespace telehug {

// A window of an X server, "Video chat with Ada", in which somebody moves a little all the time.
class ChatWindow {
 public:
  // The person is as high as the window, between black bars.
  ChatWindow(const std::string& display, const cv::Rect& place_px) : client_(display) {
    X11WindowPlan plan;
    plan.place_px = place_px;
    plan.title = "Video chat with Ada";
    window_ = client_.open(plan);
    thread_ = std::thread([this, still = still_picture(place_px.size())] { talk(still); });
  }
  ~ChatWindow() {
    ending_ = true;
    thread_.join();
  }
  ChatWindow(const ChatWindow&) = delete;
  ChatWindow& operator=(const ChatWindow&) = delete;

  [[nodiscard]] xcb_window_t window() const { return window_; }

 private:
  static cv::Mat still_picture(cv::Size size_px) {
    const auto picture = read_picture(TELEHUG_FIXTURES "/chat/01_full.jpg");
    if (!picture) throw std::runtime_error(picture.error().message);
    const int width = picture->cols * size_px.height / picture->rows;
    cv::Mat screen(size_px, CV_8UC3, cv::Scalar::all(0));
    cv::resize(*picture, screen({(size_px.width - width) / 2, 0, width, size_px.height}), {width, size_px.height});
    cv::Mat bgrx;
    cv::cvtColor(screen, bgrx, cv::COLOR_BGR2BGRA);
    return bgrx;
  }
  void talk(const cv::Mat& still) {
    for (int shade = 0; !ending_; shade = (shade + 7) % 21) {
      client_.draw(window_, {0, 0}, still + cv::Scalar::all(shade));
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
  }

  X11Client client_;
  xcb_window_t window_ = 0;
  std::atomic<bool> ending_ = false;
  std::thread thread_;
};

}  // namespace telehug
