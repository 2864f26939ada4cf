// SPDX-License-Identifier: Apache-2.0
#include "capture/virtual_rig/lens.hpp"

#include <algorithm>
#include <cmath>

namespace telehug {
namespace {

constexpr double glow_px = 1;
constexpr int glow_reach_px = 2;
constexpr int tone_rows = glow_reach_px + 1;  // of tones whose glow is not known yet, and the one whose glow is
constexpr float code_scale = 16 * 255;

}  // namespace

void root_coded(const float* light, int count, std::uint16_t* coded) {
  for (int i = 0; i < count; ++i)
    coded[i] =
        static_cast<std::uint16_t>(static_cast<int>(std::min(std::sqrt(light[i]) * code_scale + 0.5F, 65535.0F)));
}

void light_of(const std::uint16_t* coded, int count, float* light) {
  for (int i = 0; i < count; ++i) {
    const float root = static_cast<float>(coded[i]) * (1 / code_scale);
    light[i] = root * root;
  }
}

RowBlur::RowBlur(double sd_px, int reach_px) : reach_px_(reach_px) {
  double sum = 0;
  std::vector<double> bell;
  for (int i = 0; i <= reach_px; ++i) {
    bell.push_back(sd_px > 0 ? std::exp(-i * i / (2 * sd_px * sd_px)) : (i == 0 ? 1.0 : 0.0));
    sum += bell.back() * (i == 0 ? 1 : 2);
  }
  for (const double weight : bell)
    weights_.push_back(static_cast<float>(weight / sum));
}

void RowBlur::begin(int columns, int rows) {
  rows_ = rows;
  pushed_ = 0;
  done_ = 0;
  row_.resize(3 * static_cast<std::size_t>(columns + 2 * reach_px_));
  mixed_.resize(3 * static_cast<std::size_t>(columns));
  ring_.resize(mixed_.size() * static_cast<std::size_t>(2 * reach_px_ + 1));
}

Light* RowBlur::next() {
  static_assert(sizeof(Light) == 3 * sizeof(float));
  return reinterpret_cast<Light*>(row_.data()) + reach_px_;
}

void RowBlur::push() {
  const std::size_t count = mixed_.size();
  Light* row = next();
  std::fill_n(row - reach_px_, reach_px_, row[0]);
  std::fill_n(row + count / 3, reach_px_, row[count / 3 - 1]);
  const float* values = row->val;
  float* blurred = &ring_[static_cast<std::size_t>(pushed_ % (2 * reach_px_ + 1)) * count];
  for (std::size_t j = 0; j < count; ++j)
    blurred[j] = weights_[0] * values[j];
  for (int i = 1; i <= reach_px_; ++i) {
    const float weight = weights_[static_cast<std::size_t>(i)];
    const float* before = values - 3 * i;
    const float* behind = values + 3 * i;
    for (std::size_t j = 0; j < count; ++j)
      blurred[j] += weight * (before[j] + behind[j]);
  }
  ++pushed_;
}

const float* RowBlur::blurred_row(int row) const {
  const int slot = std::clamp(row, 0, rows_ - 1) % (2 * reach_px_ + 1);
  return &ring_[static_cast<std::size_t>(slot) * mixed_.size()];
}

void RowBlur::mix(int row) {
  const std::size_t count = mixed_.size();
  const float* here = blurred_row(row);
  float* mixed = mixed_.data();
  for (std::size_t j = 0; j < count; ++j)
    mixed[j] = weights_[0] * here[j];
  for (int i = 1; i <= reach_px_; ++i) {
    const float weight = weights_[static_cast<std::size_t>(i)];
    const float* above = blurred_row(row - i);
    const float* below = blurred_row(row + i);
    for (std::size_t j = 0; j < count; ++j)
      mixed[j] += weight * (above[j] + below[j]);
  }
}

Lens::Lens(double blur_px, double sharpening)
    : sharpening_(static_cast<float>(sharpening)),
      blur_(blur_px, blur_px > 0 ? std::max(1, static_cast<int>(std::ceil(2.5 * blur_px))) : 0),
      glow_(glow_px, sharpening > 0 ? glow_reach_px : 0) {}

void Lens::take_roots(int row, const float* light, std::size_t count) {
  tones_.resize(count * tone_rows);
  float* tones = &tones_[static_cast<std::size_t>(row % tone_rows) * count];
  for (std::size_t j = 0; j < count; ++j)
    tones[j] = std::sqrt(light[j]);
  std::copy_n(tones, count, glow_.next()->val);
  glow_.push();
}

void Lens::store(const cv::Rect& around, const cv::Rect& box, cv::Mat& coded) {
  glow_.completed([&](int row, const float* glow, std::size_t count) {
    if (row + around.y >= box.y && row + around.y < box.y + box.height) store_row(row, glow, count, around, box, coded);
  });
}

void Lens::store_row(int row, const float* glow, std::size_t count, const cv::Rect& around, const cv::Rect& box,
                     cv::Mat& coded) {
  const std::ptrdiff_t skipped = 3 * static_cast<std::ptrdiff_t>(box.x - around.x);
  const float* tones = &tones_[static_cast<std::size_t>(row % tone_rows) * count] + skipped;
  glow += skipped;
  auto* out = coded.ptr<std::uint16_t>(row + around.y) + 3 * static_cast<std::ptrdiff_t>(box.x);
  for (int j = 0; j < 3 * box.width; ++j) {
    const float tone = tones[j] + sharpening_ * (tones[j] - glow[j]);
    out[j] = static_cast<std::uint16_t>(static_cast<int>(std::clamp(tone * code_scale + 0.5F, 0.0F, 65535.0F)));
  }
}

}  // namespace telehug
