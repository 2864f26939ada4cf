// SPDX-License-Identifier: Apache-2.0
#include "capture/virtual_rig/development.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "pictures/jpeg_encoder.hpp"

namespace telehug {
namespace {

constexpr int noise_shift_px = 64;
constexpr double grain_px = 0.5;  // webcams smooth their noise a little
constexpr double code_scale = 16;
constexpr std::uint64_t golden = 0x9E3779B97F4A7C15ULL;

// Of every eighth pixel and row, 0 to 255 and, where it is too bright for a picture, 255.
double mean_tone(const cv::Mat& coded) {
  double sum = 0;
  int count = 0;
  for (int v = 0; v < coded.rows; v += 8) {
    const auto* row = coded.ptr<cv::Vec3w>(v);
    for (int u = 0; u < coded.cols; u += 8, ++count)
      sum += std::min(255.0, (row[u][0] + row[u][1] + row[u][2]) / (3 * code_scale));
  }
  return sum / count;
}

}  // namespace

Development::Development(const VirtualRigSettings& settings)
    : sensor_(settings.sensor),
      lens_(settings.sensor.blur_px, settings.sensor.sharpening),
      seed_(settings.seed),
      noisy_(settings.noise_sd > 0) {
  if (!noisy_) return;
  cv::RNG generator(settings.seed + golden);
  cv::Mat noise(settings.image.height_px + noise_shift_px, settings.image.width_px + noise_shift_px, CV_32FC3);
  generator.fill(noise, cv::RNG::NORMAL, 0, 1);
  cv::GaussianBlur(noise, noise, {3, 3}, grain_px);
  cv::Mat mean;
  cv::Mat deviation;
  cv::meanStdDev(noise.reshape(1), mean, deviation);
  const double scale = settings.noise_sd / deviation.at<double>(0);
  noise.convertTo(brighter_, CV_8U, scale);  // what is below 0 becomes 0
  noise.convertTo(darker_, CV_8U, -scale);
}

void Development::expose(const cv::Mat& coded, double exposure, cv::Mat& bgr) const {
  coded.convertTo(bgr, CV_8U, std::sqrt(exposure) / code_scale);
}

double Development::exposure_of(const cv::Mat& coded, std::uint64_t picture) const {
  double exposure = sensor_.exposure;
  if (sensor_.auto_exposure > 0) {
    const double tone = std::max(1.0, mean_tone(coded) * std::sqrt(exposure));
    exposure *= std::clamp(std::pow(sensor_.target_tone / tone, 2 * sensor_.auto_exposure), 0.2, 6.0);
  }
  if (sensor_.exposure_spread > 0) {
    cv::RNG generator((picture + 77) * golden + seed_);
    exposure *= std::exp(generator.gaussian(sensor_.exposure_spread));
  }
  return exposure;
}

void Development::add_noise(std::uint64_t picture, cv::Mat& bgr) const {
  if (!noisy_) return;
  cv::RNG place(picture * golden + seed_ + 1);
  // One corner for both halves: together they are normally distributed.
  const int down_px = place.uniform(0, noise_shift_px);
  const int right_px = place.uniform(0, noise_shift_px);
  const cv::Rect part({right_px, down_px}, bgr.size());
  cv::add(bgr, brighter_(part), bgr);
  cv::subtract(bgr, darker_(part), bgr);
}

void Development::compress(cv::Mat& bgr) {
  if (sensor_.jpeg_quality <= 0) return;
  const auto bytes = encode_jpeg(bgr, sensor_.jpeg_quality);
  JpegDecoder decoder;
  if (bytes) (void)decoder.decode(*bytes, bgr);
}

}  // namespace telehug
