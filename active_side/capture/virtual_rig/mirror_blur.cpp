// SPDX-License-Identifier: Apache-2.0
#include "capture/virtual_rig/mirror_blur.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/core/hal/intrin.hpp>

namespace telehug {
namespace {

constexpr double sideways = 0.2;  // sine of a grazing angle of 12 degrees

// Sum of all values before a place on a column, given the sums before each row; beyond the ends they go on as they are.
cv::v_float32x4 sum_before(const std::vector<cv::Vec4f>& sums, float place) {
  const auto last = static_cast<int>(sums.size()) - 2;
  const int row = std::clamp(static_cast<int>(place), 0, last);
  const cv::v_float32x4 before = cv::v_load(sums[static_cast<std::size_t>(row)].val);
  const cv::v_float32x4 after = cv::v_load(sums[static_cast<std::size_t>(row) + 1].val);
  return before + (after - before) * cv::v_setall_f32(place - static_cast<float>(row));
}

}  // namespace

MirrorBlur::MirrorBlur(double roughness_deg, double focal_px, double camera_z_mm)
    : px_per_share_(2 * focal_px * std::tan(roughness_deg * std::numbers::pi / 180)), camera_z_mm_(camera_z_mm) {}

void MirrorBlur::apply(cv::Mat& image, const cv::Mat& height_mm) {
  if (px_per_share_ < 0.3) return;
  for (int column = 0; column < image.cols; ++column)
    blur_column(image, height_mm, column);
  // Sideways by the same share of what each row was blurred.
  cv::Mat turned = image.t();
  cv::Mat turned_height = height_mm.t();
  const double upright = px_per_share_;
  px_per_share_ *= sideways;
  for (int column = 0; column < turned.cols; ++column)
    blur_column(turned, turned_height, column);
  px_per_share_ = upright;
  cv::Mat(turned.t()).copyTo(image);
}

int MirrorBlur::reach_px() const {
  return static_cast<int>(std::min(0.5 * px_per_share_, 60.0)) + 1;
}

// A box of half width 1.7 standard deviations has that standard deviation; each row has a box of its own. Rows without
// coverage take the height of the nearest covered row, since that is what may be blurred onto them.
void MirrorBlur::blur_column(cv::Mat& image, const cv::Mat& height_mm, int column) {
  const auto rows = static_cast<std::size_t>(image.rows);
  sums_.resize(rows + 1);
  reach_px_.assign(rows, -1);
  bool any = false;
  for (std::size_t row = 0; row < rows; ++row) {
    const auto v = static_cast<int>(row);
    if (image.at<cv::Vec4f>(v, column)[3] <= 0) continue;
    const double h = std::max(0.0, static_cast<double>(height_mm.at<float>(v, column)));
    reach_px_[row] = static_cast<float>(1.7 * px_per_share_ * h / (camera_z_mm_ + h));
    any = true;
  }
  if (!any) return;
  std::ptrdiff_t covered = -1;
  for (std::size_t row = 0; row < rows; ++row) {
    if (reach_px_[row] < 0) continue;
    const auto here = static_cast<std::ptrdiff_t>(row);
    for (std::ptrdiff_t gap = covered + 1; gap < here; ++gap) {
      const bool nearer_before = covered >= 0 && gap - covered <= here - gap;
      reach_px_[static_cast<std::size_t>(gap)] = reach_px_[static_cast<std::size_t>(nearer_before ? covered : here)];
    }
    covered = here;
  }
  for (auto gap = static_cast<std::size_t>(covered + 1); gap < rows; ++gap)
    reach_px_[gap] = reach_px_[static_cast<std::size_t>(covered)];

  for (int pass = 0; pass < 2; ++pass) {  // two boxes make a triangle, much like the bell of a rough surface
    cv::v_float32x4 sum = cv::v_setzero_f32();
    for (std::size_t row = 0; row < rows; ++row) {
      cv::v_store(sums_[row].val, sum);
      sum += cv::v_load(image.ptr<float>(static_cast<int>(row), column));
    }
    cv::v_store(sums_[rows].val, sum);
    for (std::size_t row = 0; row < rows; ++row) {
      const float half = std::max(0.5F, reach_px_[row] / std::numbers::sqrt2_v<float>);
      const float middle = static_cast<float>(row) + 0.5F;
      const cv::v_float32x4 within = sum_before(sums_, middle + half) - sum_before(sums_, middle - half);
      cv::v_store(image.ptr<float>(static_cast<int>(row), column), within * cv::v_setall_f32(0.5F / half));
    }
  }
}

}  // namespace telehug
