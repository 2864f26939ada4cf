// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

#include "calibration/rig_residuals.hpp"

namespace telehug {

// What a camera sees of a monitor's lower edge: a desk, a bezel with a ridge, and below the border a screen that shows
// something else for every `content`. Edges are as sharp as half a pixel; `gain` is the exposure.
inline cv::Mat drawn_bezel(const RigCamera& camera, const ScreenSize& screen, unsigned content = 0, double gain = 1,
                           double noise_sd = 3) {
  const ImageSize image = camera.image();
  const double up = camera.orientation().top_bottom_exchanged ? -1 : 1;
  cv::Mat picture(image.height_px, image.width_px, CV_8UC3);
  cv::RNG random(1234 + content);
  for (int u = 0; u < image.width_px; ++u) {
    const double border = border_row(camera, screen.height_mm, u).value_or(image.height_px / 2.0);
    for (int v = 0; v < image.height_px; ++v) {
      double grey = 0;
      for (const double part : {-0.375, -0.125, 0.125, 0.375}) {
        const double above = up * (border - (v + part));  // rows from the border towards the user
        const double shown = 60 + 50 * ((v / 9 + u / 50 + static_cast<int>(content)) % 4);
        grey += 0.25 * (above > 18 ? 150 : above > 11 ? 60 : above > 8 ? 110 : above > 0 ? 45 : shown);
      }
      grey = gain * grey + random.gaussian(noise_sd);
      picture.at<cv::Vec3b>(v, u) = cv::Vec3b::all(cv::saturate_cast<std::uint8_t>(grey));
    }
  }
  return picture;
}

}  // namespace telehug
