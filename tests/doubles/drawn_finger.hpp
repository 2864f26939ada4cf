// SPDX-License-Identifier: Apache-2.0
//
// Pictures of a desk, a dark bezel, a dark screen and a finger of known place, as a webcam on top of the monitor would
// see them; drawn, so that the truth is known to the pixel.
#pragma once

#include <cmath>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <random>

#include "calibration/border_line.hpp"
#include "common/units.hpp"

namespace telehug {

struct Bgr {
  std::uint8_t blue, green, red;
};

inline constexpr Bgr desk_colour{90, 110, 125};
inline constexpr Bgr bezel_colour{42, 42, 40};
inline constexpr Bgr screen_colour{18, 16, 16};
inline constexpr Bgr skin_colour{110, 140, 205};

class DrawnScene {
 public:
  DrawnScene(const BorderLine& border, ImageSize size)
      : border_(border), picture_(size.height_px, size.width_px, CV_8UC3) {
    paint([](int u, double row) {
      (void)u;
      if (row > 0) return screen_colour;
      return row > -bezel_px ? bezel_colour : desk_colour;
    });
  }

  // A finger upright in the picture: columns [first, first + width), and `length` rows past the border, rounded at its
  // tip over half its width.
  DrawnScene& finger(int first, int width, int length, const Bgr& colour = skin_colour) {
    const double middle = first + 0.5 * (width - 1);
    return paint_where(
        [=](int u, double row) {
          const double half = 0.5 * width;
          const double beyond = row - (length - half);  // into the round part
          const double reach = beyond <= 0 ? half : std::sqrt(std::max(0.0, half * half - beyond * beyond));
          return std::abs(u - middle) < reach;
        },
        colour);
  }

  // A rectangle in rows relative to the border.
  DrawnScene& bar(int first, int width, int from_row, int to_row, const Bgr& colour = skin_colour) {
    return paint_where(
        [=](int u, double row) { return u >= first && u < first + width && row >= from_row && row < to_row; }, colour);
  }

  DrawnScene& noise(unsigned seed, double deviation) {
    std::mt19937 random(seed);
    std::normal_distribution<double> grey(0, deviation);
    for (int v = 0; v < picture_.rows; ++v) {
      auto* const pixels = picture_.ptr<std::uint8_t>(v);
      for (int i = 0; i < 3 * picture_.cols; ++i)
        pixels[i] = cv::saturate_cast<std::uint8_t>(pixels[i] + grey(random));
    }
    return *this;
  }

  [[nodiscard]] const cv::Mat& picture() const { return picture_; }

 private:
  static constexpr int bezel_px = 22;

  void put(int u, int v, const Bgr& colour) { picture_.at<cv::Vec3b>(v, u) = {colour.blue, colour.green, colour.red}; }

  template <typename ColourAt>
  void paint(ColourAt colour_at) {
    for (int v = 0; v < picture_.rows; ++v) {
      for (int u = 0; u < picture_.cols; ++u)
        put(u, v, colour_at(u, v - border_.v_at(u)));
    }
  }

  template <typename Inside>
  DrawnScene& paint_where(Inside inside, const Bgr& colour) {
    for (int v = 0; v < picture_.rows; ++v) {
      for (int u = 0; u < picture_.cols; ++u) {
        if (inside(u, v - border_.v_at(u))) put(u, v, colour);
      }
    }
    return *this;
  }

  BorderLine border_;
  cv::Mat picture_;
};

}  // namespace telehug
