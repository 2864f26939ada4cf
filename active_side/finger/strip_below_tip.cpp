// SPDX-License-Identifier: Apache-2.0
#include "finger/strip_below_tip.hpp"

#include <algorithm>
#include <cmath>

namespace telehug {

StripBelowTip::StripBelowTip(const cv::Mat& bgr, const ImagePoint& begin, double u_per_v, double half_width_px)
    : half_width_px_(half_width_px), picture_width_px_(bgr.cols) {
  const double cell_px = half_width_px / cells_per_half_width;
  for (; rows_ < most_rows; ++rows_) {
    const double down_px = (rows_ + 0.5) * row_px;
    // The second and the fourth of its lines stand for a row.
    const auto upper = static_cast<int>(std::lround(begin.v_px + down_px - 1));
    const int lower = upper + 2;
    if (upper < 0 || lower >= bgr.rows - 1) break;
    middle_u_px_[rows_] = begin.u_px + u_per_v * down_px;
    auto& sums = sums_[rows_];
    sums[0] = {};
    const double left_u_px = middle_u_px_[rows_] - reach * half_width_px;
    auto from = static_cast<int>(std::lround(left_u_px));
    for (int cell = 0; cell < cells; ++cell) {
      const auto next = static_cast<int>(std::lround(left_u_px + (cell + 1) * cell_px));
      const int first = std::clamp(from, 0, bgr.cols - 1);
      const int end = std::clamp(next, first + 1, bgr.cols);
      cv::Vec3i sum;
      const auto* above = bgr.ptr<cv::Vec3b>(upper);
      const auto* below = bgr.ptr<cv::Vec3b>(lower);
      for (int u = first; u < end; ++u) {
        for (int c = 0; c < 3; ++c)
          sum[c] += above[u][c] + below[u][c];
      }
      sums[cell + 1] = sums[cell] + cv::Vec3f(sum) * (0.5F / static_cast<float>(end - first));
      from = next;
    }
  }
}

bool StripBelowTip::holds(int row, double from, double to) const {
  const double left_u_px = middle_u_px_[row] + from * half_width_px_;
  const double right_u_px = middle_u_px_[row] + to * half_width_px_;
  return from >= -reach && to <= reach && left_u_px >= 1 && right_u_px <= picture_width_px_ - 2;
}

cv::Vec3f StripBelowTip::sum_before(int row, double place) const {
  const double at = std::clamp((place + reach) * cells_per_half_width, 0.0, cells - 0.001);
  const auto cell = static_cast<int>(at);
  const auto& sums = sums_[row];
  return sums[cell] + (sums[cell + 1] - sums[cell]) * static_cast<float>(at - cell);
}

}  // namespace telehug
