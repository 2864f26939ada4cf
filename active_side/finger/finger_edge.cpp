// SPDX-License-Identifier: Apache-2.0
#include "finger/finger_edge.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>

namespace telehug {
namespace {

// Least squares of points that come in one after the other.
class GrowingLine {
 public:
  void add(double v, double u) {
    n_ += 1;
    v_ += v;
    u_ += u;
    vv_ += v * v;
    uv_ += u * v;
  }
  [[nodiscard]] FingerEdge line(const FingerEdge& first, double first_weight) const {
    // The edge that was known before counts like points on it, spread over `reach` rows.
    constexpr double reach = 8;
    const double v0 = first.v_px;
    const double n = n_ + first_weight;
    const double v_mean = (v_ + first_weight * v0) / n;
    const double u_mean = (u_ + first_weight * first.u_px) / n;
    const double spread = vv_ + first_weight * (v0 * v0 + reach * reach) - n * v_mean * v_mean;
    const double joint = uv_ + first_weight * (v0 * first.u_px + reach * reach * first.slope) - n * v_mean * u_mean;
    return {u_mean, v_mean, joint / std::max(spread, 1e-9)};
  }

 private:
  double n_ = 0;
  double v_ = 0;
  double u_ = 0;
  double vv_ = 0;
  double uv_ = 0;
};

}  // namespace

FingerEdge follow_edge(const cv::Mat& bgr, const FingerEdge& coarse, double scale) {
  constexpr int reach = 4;  // columns to each side of where the edge is expected
  constexpr int mean = 3;   // columns and rows that are averaged on each side of a step
  constexpr int places = 2 * reach + 1;
  constexpr int row_step = 2;
  constexpr int most_lost = 4;       // rows without an edge that end it
  constexpr double least_step = 16;  // grey levels, sum of the channels
  constexpr double first_px = 3;     // the border itself is an edge, too
  constexpr double up_px = 65;
  constexpr double down_px = 40;
  constexpr double coarse_weight = 3;
  GrowingLine all;
  const auto follow = [&](double first_offset, double last_offset, int direction) {
    int lost = 0;
    for (double offset = first_offset; direction * (last_offset - offset) >= 0; offset += direction * row_step) {
      const FingerEdge expected = all.line(coarse, coarse_weight);
      const auto row = static_cast<int>(std::lround(coarse.v_px + offset));
      const auto middle = static_cast<int>(std::lround(expected.u_at(row)));
      if (row < 1 || row > bgr.rows - 2 || middle < reach + mean || middle >= bgr.cols - reach - mean) return;
      // Interleaved channels of all columns that count, three rows together; then the steps at each place.
      std::array<int, std::size_t{3} * (places + 2 * mean)> sum;
      const std::uint8_t* const pixels = bgr.ptr<std::uint8_t>(row) + 3 * (middle - reach - mean);
      const std::uint8_t* const above = pixels - bgr.step[0];
      const std::uint8_t* const below = pixels + bgr.step[0];
      for (std::size_t i = 0; i < sum.size(); ++i)
        sum[i] = above[i] + pixels[i] + below[i];
      std::array<int, std::size_t{3} * places> difference;
      for (std::size_t i = 0; i < difference.size(); ++i)
        difference[i] = std::abs(sum[i + 12] + sum[i + 15] + sum[i + 18] - sum[i] - sum[i + 3] - sum[i + 6]);
      std::array<double, places> step;
      std::size_t best = 0;
      for (std::size_t i = 0; i < step.size(); ++i) {
        step[i] = (difference[3 * i] + difference[3 * i + 1] + difference[3 * i + 2]) / 9.0;
        if (step[i] > step[best]) best = i;
      }
      // At the end of the search there may be more beyond it: something else.
      if (step[best] < least_step || best == 0 || best + 1 == step.size()) {
        if (++lost > most_lost) return;
        continue;
      }
      lost = 0;
      const double bend = step[best - 1] - 2 * step[best] + step[best + 1];
      const double part = bend < 0 ? 0.5 * (step[best - 1] - step[best + 1]) / bend : 0;
      all.add(row, middle - reach + static_cast<double>(best) + part);
    }
  };
  follow(-first_px * scale, -up_px * scale, -1);
  follow(first_px * scale, down_px * scale, 1);
  return all.line(coarse, coarse_weight);
}

}  // namespace telehug
