// SPDX-License-Identifier: Apache-2.0
#include "capture/light_meter.hpp"

#include <chrono>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace telehug {

void LightMeter::add(const cv::Mat& bgr, Timestamp time) {
  constexpr int dark_below = 16;
  constexpr int blown_above = 250;
  cv::Mat grey;
  cv::cvtColor(bgr, grey, cv::COLOR_BGR2GRAY);
  const auto pixels = static_cast<double>(grey.total());
  const double mean = cv::mean(grey)[0] / 255;
  if (sums_.pictures == 0) first_ = time;
  // A hand that moves changes it steadily, a lamp back and forth.
  if (sums_.pictures > 1) change_ += std::abs(mean - 2 * newest_mean_ + mean_before_) / 2;
  ++sums_.pictures;
  sums_.mean += mean;
  sums_.dark_share += cv::countNonZero(grey < dark_below) / pixels;
  sums_.blown_share += cv::countNonZero(grey > blown_above) / pixels;
  mean_before_ = newest_mean_;
  newest_mean_ = mean;
  newest_ = time;
}

Light LightMeter::light() const {
  Light light = sums_;
  if (light.pictures == 0) return light;
  const double count = light.pictures;
  light.mean /= count;
  light.dark_share /= count;
  light.blown_share /= count;
  if (light.pictures < 2) return light;
  if (light.pictures > 2 && light.mean > 0) light.flicker = change_ / (count - 2) / light.mean;
  const double seconds = std::chrono::duration<double>(newest_ - first_).count();
  if (seconds > 0) light.rate_hz = (count - 1) / seconds;
  return light;
}

}  // namespace telehug
