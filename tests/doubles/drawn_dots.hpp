// SPDX-License-Identifier: Apache-2.0
//
// Pictures of a calibration's white dot on a black screen as a known camera would take them, and what else can be
// there.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "calibration/rig_camera.hpp"

namespace telehug {

class DrawnDots {
 public:
  explicit DrawnDots(const RigCamera& camera) : camera_(camera) {
    const ImageSize image = camera.image();
    fine_.create(image.height_px * fine, image.width_px * fine, CV_8UC3);
    fine_.setTo(cv::Scalar(46, 44, 42));
  }

  // A circle on the screen.
  DrawnDots& dot(const ScreenPoint& centre, const cv::Scalar& colour = {225, 222, 220}, double diameter_mm = 10) {
    std::vector<cv::Point> outline;
    for (int i = 0; i < 180; ++i) {
      const double t = i * std::numbers::pi / 90;
      outline.push_back(fixed(*camera_.project(
          ScreenPoint{centre.x_mm + diameter_mm / 2 * std::cos(t), centre.y_mm + diameter_mm / 2 * std::sin(t)})));
    }
    fill(outline, colour);
    return *this;
  }

  // A finger from below the screen whose tip ends at `contact`: a bar with a round end that hides what is behind it.
  DrawnDots& finger(const ScreenPoint& contact, const cv::Scalar& colour = {105, 140, 195}, double width_mm = 11) {
    const ImagePoint tip = *camera_.project(contact);
    const ImagePoint side = *camera_.project(ScreenPoint{contact.x_mm + width_mm / 2, contact.y_mm});
    const double radius = std::abs(side.u_px - tip.u_px);
    std::vector<cv::Point> outline;
    for (int i = 0; i <= 60; ++i) {
      const double t = i * std::numbers::pi / 60;
      outline.push_back(fixed({tip.u_px + radius * std::cos(t), tip.v_px - radius + radius * std::sin(t)}));
    }
    outline.push_back(fixed({tip.u_px - radius, 0}));
    outline.push_back(fixed({tip.u_px + radius, 0}));
    fill(outline, colour);
    return *this;
  }

  // With the lens' blur and the sensor's noise.
  [[nodiscard]] cv::Mat picture(std::uint64_t seed = 1) const {
    const ImageSize image = camera_.image();
    cv::Mat bgr;
    cv::resize(fine_, bgr, {image.width_px, image.height_px}, 0, 0, cv::INTER_AREA);
    cv::GaussianBlur(bgr, bgr, {}, 0.9 * image.width_px / 1280);
    cv::Mat noise(bgr.size(), CV_16SC3);
    cv::RNG(seed).fill(noise, cv::RNG::NORMAL, 0, 3);
    cv::add(bgr, noise, bgr, cv::noArray(), CV_8UC3);
    return bgr;
  }

 private:
  static constexpr int fine = 4;
  static constexpr int bits = 6;

  static cv::Point fixed(const ImagePoint& point) {
    const auto part = [](double value) {
      return static_cast<int>(std::lround(((value + 0.5) * fine - 0.5) * (1 << bits)));
    };
    return {part(point.u_px), part(point.v_px)};
  }
  void fill(const std::vector<cv::Point>& outline, const cv::Scalar& colour) {
    cv::fillPoly(fine_, std::vector<std::vector<cv::Point>>{outline}, colour, cv::LINE_AA, bits);
  }

  RigCamera camera_;
  cv::Mat fine_;
};

}  // namespace telehug
