// SPDX-License-Identifier: Apache-2.0
//
// A drawn fingertip before a drawn screen, and its mirror image.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <opencv2/core/mat.hpp>

#include "finger/mirror_evidence.hpp"

namespace telehug {

// What is drawn; lengths without scale are px at scale 1, where a millimetre along the screen's normal is 4.5 px.
struct DrawnMirror {
  double hover_mm = 0;
  double share = 0.3;  // of the finger's light that the screen mirrors; 0: a screen that does not mirror
  double scale = 1;
  double roll = 0;        // slope of the image of the screen's normal
  double lean = 0;        // slope of the finger against the screen's normal
  double flatness = 1;    // the mirror image is that much shorter than the finger
  double tip_v_px = 300;  // at scale 1
  double tip_u_px = 640;  // not scaled
  cv::Vec3b finger{120, 150, 200};
  std::function<cv::Vec3d(double u_px, double v_px)> screen = [](double, double) { return cv::Vec3d(40, 40, 40); };
  double noise_sd = 2;

  static constexpr double half_width_px = 30;

  [[nodiscard]] ScreenNormal normal() const { return {roll, 4.5 * scale}; }
  [[nodiscard]] double tip_v() const { return tip_v_px * scale; }
  [[nodiscard]] double gap_px() const { return 2 * hover_mm * 4.5 * scale; }

  [[nodiscard]] FingerOutline outline() const {
    FingerOutline outline;
    outline.tip = {tip_u_px, tip_v()};
    outline.reference_v_px = tip_v() - 60 * scale;
    outline.centre_slope = roll - lean;
    outline.centre_u_px = tip_u_px - 60 * scale * outline.centre_slope;
    outline.half_width_px = half_width_px * scale;
    return outline;
  }

  // The same for the same values.
  [[nodiscard]] cv::Mat picture() const {
    cv::Mat bgr(720, 1280, CV_8UC3);
    std::uint32_t random = 1;
    const auto noise = [&random, this] {  // of standard deviation noise_sd, from a linear congruential generator
      random = random * 1664525U + 1013904223U;
      return noise_sd * 3.46 * (static_cast<double>(random >> 8U) / 16777216.0 - 0.5);
    };
    for (int v = 0; v < bgr.rows; ++v) {
      for (int u = 0; u < bgr.cols; ++u) {
        cv::Vec3d light = screen(u, v);
        const double along = v - tip_v();  // along the screen's normal, downwards
        const double across = u - tip_u_px - roll * along;
        if (in_finger(across, -along)) {
          light = cv::Vec3d(finger);
        } else if (in_finger(across, (along - gap_px()) * flatness)) {
          light = light * (1 - share) + cv::Vec3d(finger) * share;
        }
        for (int c = 0; c < 3; ++c)
          bgr.at<cv::Vec3b>(v, u)[c] = static_cast<std::uint8_t>(std::clamp(light[c] + noise(), 0.0, 255.0));
      }
    }
    return bgr;
  }

 private:
  // A stadium's end: `across` from the line through the tip, `up` from the tip along the normal.
  [[nodiscard]] bool in_finger(double across, double up) const {
    const double radius = half_width_px * scale;
    const double from_centre = std::abs(across - lean * up);
    if (up < 0 || from_centre > radius) return false;
    return up >= radius - std::sqrt(radius * radius - from_centre * from_centre);
  }
};

}  // namespace telehug
