// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <random>

namespace telehug {

// A straight finger: a band about u = u_px + slope (v - v_px), with a tip that is half an ellipse, drawn with soft
// edges so that its place is known to parts of a pixel.
struct DrawnBand {
  double u_px = 0;
  double v_px = 0;
  double slope = 0;
  double half_width_px = 25;
  double tip_v_px = 1e9;      // row of the foremost point; beyond the picture: the band never ends
  double tip_length_px = 25;  // from its root to its foremost point
  cv::Vec3d colour{110, 140, 205};
  double opacity = 1;      // less: a shadow, whose colour is black then
  double softness_px = 1;  // of the edges
};

// A desk of several colours, with noise of a webcam if asked for.
inline cv::Mat drawn_desk(int columns, int rows, unsigned seed = 1, double noise = 0) {
  cv::Mat picture(rows, columns, CV_8UC3);
  std::mt19937 random(seed);
  std::normal_distribution<double> grey(0, 1);
  for (int v = 0; v < rows; ++v) {
    for (int u = 0; u < columns; ++u) {
      const double wave = 15 * std::sin(u / 40.0) + 10 * std::cos(v / 30.0);
      for (int c = 0; c < 3; ++c)
        picture.at<cv::Vec3b>(v, u)[c] = cv::saturate_cast<std::uint8_t>(70 + 10 * c + wave + noise * grey(random));
    }
  }
  return picture;
}

inline void draw_band(cv::Mat& picture, const DrawnBand& band) {
  const double root_v = band.tip_v_px - band.tip_length_px;
  for (int v = 0; v < picture.rows && v <= band.tip_v_px + 1; ++v) {
    double half = band.half_width_px;
    if (v > root_v) {
      const double y = std::min(1.0, (v - root_v) / band.tip_length_px);
      half *= std::sqrt(1 - y * y);
    }
    const double centre = band.u_px + band.slope * (v - band.v_px);
    for (int u = 0; u < picture.cols; ++u) {
      const double inside = (half - std::abs(u - centre)) / band.softness_px + 0.5;
      const double share = band.opacity * std::clamp(inside, 0.0, 1.0);
      auto& pixel = picture.at<cv::Vec3b>(v, u);
      for (int c = 0; c < 3; ++c)
        pixel[c] = cv::saturate_cast<std::uint8_t>((1 - share) * pixel[c] + share * band.colour[c]);
    }
  }
}

}  // namespace telehug
