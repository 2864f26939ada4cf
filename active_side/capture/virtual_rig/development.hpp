// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>

#include "capture/virtual_rig/lens.hpp"
#include "capture/virtual_rig/settings.hpp"
#include "pictures/jpeg_decoder.hpp"

namespace telehug {

// From light to a webcam's picture: lens, then, for the whole picture, exposure, noise and JPEG. `coded` pictures
// (CV_16UC3) hold 16 * 255 * sqrt(light) and have room for what is too bright for 8 bits.
class Development {
 public:
  explicit Development(const VirtualRigSettings& settings);

  [[nodiscard]] Lens& lens() noexcept { return lens_; }

  // CV_16UC3 to CV_8UC3 with this exposure; no noise.
  void expose(const cv::Mat& coded, double exposure, cv::Mat& bgr) const;

  // What the settings' automatic exposure and its spread make of a picture: a factor for linear light.
  [[nodiscard]] double exposure_of(const cv::Mat& coded, std::uint64_t picture) const;

  // The same `picture` gives the same noise.
  void add_noise(std::uint64_t picture, cv::Mat& bgr) const;

  // What coding as JPEG leaves of it, if the settings say so.
  void compress(cv::Mat& bgr);

 private:
  SensorLooks sensor_;
  Lens lens_;
  std::uint64_t seed_;
  bool noisy_;
  cv::Mat brighter_;  // noise to add and to subtract, larger than a picture by noise_shift_px
  cv::Mat darker_;
};

}  // namespace telehug
