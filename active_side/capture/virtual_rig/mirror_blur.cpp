// SPDX-License-Identifier: Apache-2.0
#include "capture/virtual_rig/mirror_blur.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace telehug {
namespace {

constexpr double sideways = 0.2;  // sine of a grazing angle of 12 degrees

// Sum of all values before a place on a column, given the sums before each row; beyond the ends they go on as they are.
cv::Vec4f sum_before(const std::vector<cv::Vec4f>& sums, float place) {
  const std::size_t last = sums.size() - 2;
  if (place <= 0) return sums[1] * place;
  const std::size_t row = std::min(last, static_cast<std::size_t>(place));
  return sums[row] + (sums[row + 1] - sums[row]) * (place - static_cast<float>(row));
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
    sums_[0] = {};
    for (std::size_t row = 0; row < rows; ++row)
      sums_[row + 1] = sums_[row] + image.at<cv::Vec4f>(static_cast<int>(row), column);
    for (std::size_t row = 0; row < rows; ++row) {
      const float half = std::max(0.5F, reach_px_[row] / std::numbers::sqrt2_v<float>);
      const float middle = static_cast<float>(row) + 0.5F;
      image.at<cv::Vec4f>(static_cast<int>(row), column) =
          (sum_before(sums_, middle + half) - sum_before(sums_, middle - half)) * (1 / (2 * half));
    }
  }
}

}  // namespace telehug
