// SPDX-License-Identifier: Apache-2.0
#include "capture/virtual_rig/mirror_blur.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <opencv2/core/hal/intrin.hpp>

namespace telehug {
namespace {

constexpr float sideways = 0.2F;  // sine of a grazing angle of 12 degrees
constexpr float least_half_px = 0.5F;

// Sum of all values before a place, given the sums before each row (or column) `stride` apart; beyond the ends they go
// on as they are.
cv::v_float32x4 sum_before(const cv::Vec4f* sums, std::ptrdiff_t stride, int last, float place) {
  const int row = std::clamp(static_cast<int>(place), 0, last);
  const cv::Vec4f* at = sums + row * stride;
  const cv::v_float32x4 before = cv::v_load(at->val);
  const cv::v_float32x4 after = cv::v_load(at[stride].val);
  return before + (after - before) * cv::v_setall_f32(place - static_cast<float>(row));
}

cv::v_float32x4 box_mean(const cv::Vec4f* sums, std::ptrdiff_t stride, int last, int place, float half) {
  const float middle = static_cast<float>(place) + 0.5F;
  const cv::v_float32x4 within =
      sum_before(sums, stride, last, middle + half) - sum_before(sums, stride, last, middle - half);
  return within * cv::v_setall_f32(0.5F / half);
}

}  // namespace

MirrorBlur::MirrorBlur(double roughness_deg, double focal_px, double camera_z_mm)
    : px_per_share_(2 * focal_px * std::tan(roughness_deg * std::numbers::pi / 180)), camera_z_mm_(camera_z_mm) {}

void MirrorBlur::apply(PictureLayer& layer) {
  if (px_per_share_ < 0.3 || layer.box.empty()) return;
  layer.widen_columns(reach_px(), static_cast<int>(sideways * static_cast<float>(reach_px())) + 1);
  find_half_heights(layer);
  for (int pass = 0; pass < 2; ++pass)  // two boxes make a triangle, much like the bell of a rough surface
    blur_upright(layer);
  blur_sideways(layer);
}

int MirrorBlur::reach_px() const {
  return static_cast<int>(std::min(0.5 * px_per_share_, 60.0)) + 1;
}

// A box of half width 1.7 standard deviations has that standard deviation, and so have two of 1 / sqrt(2) of it one
// after the other; each pixel has a box of its own. Pixels without coverage take that of the nearest covered row, since
// that is what may be blurred onto them.
void MirrorBlur::find_half_heights(const PictureLayer& layer) {
  const cv::Mat& image = layer.image;
  const auto camera_z = static_cast<float>(camera_z_mm_);
  const auto px_per_share = static_cast<float>(1.7 / std::numbers::sqrt2 * px_per_share_);
  const auto columns = static_cast<std::size_t>(image.cols);
  const auto far = static_cast<float>(2 * image.rows);
  half_px_.create(image.size(), CV_32FC1);
  away_px_.create(image.size(), CV_32FC1);
  carried_px_.assign(columns, 0);
  carried_away_px_.assign(columns, far);
  for (int v = 0; v < image.rows; ++v) {
    const auto* pixel = image.ptr<cv::Vec4f>(v);
    const float* height = layer.height_mm.ptr<float>(v);
    float* half = half_px_.ptr<float>(v);
    float* away = away_px_.ptr<float>(v);
    for (std::size_t u = 0; u < columns; ++u) {
      const float h = std::max(0.0F, height[u]);
      const bool covered = pixel[u][3] > 0;
      half[u] = carried_px_[u] = covered ? px_per_share * h / (camera_z + h) : carried_px_[u];
      away[u] = carried_away_px_[u] = covered ? 0 : carried_away_px_[u] + 1;
    }
  }
  carried_away_px_.assign(columns, far);
  for (int v = image.rows - 1; v >= 0; --v) {
    float* half = half_px_.ptr<float>(v);
    const float* away = away_px_.ptr<float>(v);
    for (std::size_t u = 0; u < columns; ++u) {
      const float from_below = carried_away_px_[u] + 1;
      const bool below_nearer = from_below < away[u];
      carried_px_[u] = below_nearer ? carried_px_[u] : half[u];
      carried_away_px_[u] = below_nearer ? from_below : away[u];
      half[u] = std::max(least_half_px, carried_px_[u]);
    }
  }
}

void MirrorBlur::blur_upright(PictureLayer& layer) {
  cv::Mat& image = layer.image;
  sums_.create(image.rows + 1, image.cols, CV_32FC4);
  std::memset(sums_.ptr(0), 0, static_cast<std::size_t>(image.cols) * sizeof(cv::Vec4f));
  for (int v = 0; v < image.rows; ++v) {
    const float* before = sums_.ptr<float>(v);
    const float* value = image.ptr<float>(v);
    float* after = sums_.ptr<float>(v + 1);
    for (int i = 0; i < 4 * image.cols; ++i)
      after[i] = before[i] + value[i];
  }
  const auto stride = static_cast<std::ptrdiff_t>(sums_.step / sizeof(cv::Vec4f));
  for (int v = 0; v < image.rows; ++v) {
    const float* half = half_px_.ptr<float>(v);
    auto* pixel = image.ptr<cv::Vec4f>(v);
    const cv::Range& columns = layer.columns[static_cast<std::size_t>(v)];
    for (int u = columns.start; u < columns.end; ++u)
      cv::v_store(pixel[u].val, box_mean(sums_.ptr<cv::Vec4f>() + u, stride, image.rows - 1, v, half[u]));
  }
}

void MirrorBlur::blur_sideways(PictureLayer& layer) {
  cv::Mat& image = layer.image;
  sums_.create(1, image.cols + 1, CV_32FC4);
  auto* sums = sums_.ptr<cv::Vec4f>();
  for (int v = 0; v < image.rows; ++v) {
    const float* half = half_px_.ptr<float>(v);
    auto* pixel = image.ptr<cv::Vec4f>(v);
    const cv::Range& columns = layer.columns[static_cast<std::size_t>(v)];
    if (columns.empty()) continue;
    for (int pass = 0; pass < 2; ++pass) {
      cv::v_float32x4 sum = cv::v_setzero_f32();
      for (int u = columns.start; u < columns.end; ++u) {
        cv::v_store(sums[u - columns.start].val, sum);
        sum += cv::v_load(pixel[u].val);
      }
      cv::v_store(sums[columns.size()].val, sum);
      for (int u = columns.start; u < columns.end; ++u) {
        const float across = std::max(least_half_px, sideways * half[u]);
        cv::v_store(pixel[u].val, box_mean(sums, 1, columns.size() - 1, u - columns.start, across));
      }
    }
  }
}

}  // namespace telehug
