// SPDX-License-Identifier: Apache-2.0
#include "finger/crossing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace telehug {
namespace {

constexpr double steepest = 0.9;
constexpr float least_edge = 1;     // mean step of an edge, in standard deviations
constexpr float most_against = -1;  // how much a rail with the opposite step counts against an edge
constexpr float far_enough = 5;     // steps beyond this are all alike: skin colours make no difference
constexpr float is_foreground = 2;
constexpr int rails_between = 10;  // from the border on, looked at for foreground between two edges
constexpr double least_foreground = 0.75;
constexpr double largest_taper = 0.65;  // difference of two edges' slopes
constexpr double narrowest_px = 25;     // in a picture 1280 columns wide: 7 mm at the far end of a 340 mm high screen
constexpr double widest_px = 190;       // 20 mm close to the camera
constexpr int apart_columns = 3;        // two peaks of one edge

double slope_of(int index, int slopes) {
  return -steepest + 2 * steepest * index / (slopes - 1);
}

// Weighted least squares with weights that fall off for points beside the line (Geman and McClure 1985).
FingerEdge robust_line(const std::array<double, 64>& v, const std::array<double, 64>& u, std::size_t n) {
  std::array<double, 64> weight;
  std::array<double, 64> distance;
  weight.fill(1);
  FingerEdge line;
  for (int round = 0; round < 6; ++round) {
    double s = 0;
    double sv = 0;
    double svv = 0;
    double su = 0;
    double suv = 0;
    for (std::size_t i = 0; i < n; ++i) {
      s += weight[i];
      sv += weight[i] * v[i];
      su += weight[i] * u[i];
    }
    line.v_px = sv / s;
    for (std::size_t i = 0; i < n; ++i) {
      const double dv = v[i] - line.v_px;
      svv += weight[i] * dv * dv;
      suv += weight[i] * dv * u[i];
    }
    line.u_px = su / s;
    line.slope = suv / std::max(svv, 1e-9);
    for (std::size_t i = 0; i < n; ++i)
      distance[i] = std::abs(u[i] - line.u_at(v[i]));
    std::array<double, 64> sorted = distance;
    std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(n / 2),
                     sorted.begin() + static_cast<std::ptrdiff_t>(n));
    const double scale = std::max(1.0, 1.5 * sorted[n / 2]);
    for (std::size_t i = 0; i < n; ++i) {
      const double z = distance[i] / scale;
      weight[i] = 1 / ((1 + z * z) * (1 + z * z));
    }
  }
  return line;
}

}  // namespace

CrossingFinder::CrossingFinder(const BorderStrip::Layout& layout)
    : layout_(layout),
      rises_(layout.cells()),
      falls_(layout.cells()),
      sums_(static_cast<std::size_t>(layout.columns)),
      best_(static_cast<std::size_t>(layout.columns)),
      best_slope_(static_cast<std::size_t>(layout.columns)) {}

// The picture's sides end a finger as well as its own edges do.
void CrossingFinder::find_steps(const std::vector<float>& foreground) {
  const int n = layout_.columns;
  for (int rail = 0; rail < BorderStrip::rails; ++rail) {
    const float* const in = foreground.data() + static_cast<std::ptrdiff_t>(rail) * n;
    float* const rise = rises_.data() + static_cast<std::ptrdiff_t>(rail) * n;
    float* const fall = falls_.data() + static_cast<std::ptrdiff_t>(rail) * n;
    for (int i = 0; i < n; ++i) {
      const float before = i > 0 ? std::min(in[i - 1], far_enough) : 0;
      const float after = i + 1 < n ? std::min(in[i + 1], far_enough) : 0;
      rise[i] = std::max(after - before, most_against);
      fall[i] = std::max(before - after, most_against);
    }
  }
}

void CrossingFinder::find_edges(const std::vector<float>& steps, Peaks& peaks) {
  const int n = layout_.columns;
  std::fill(best_.begin(), best_.end(), 0.0F);
  for (int s = 0; s < slopes; ++s) {
    std::fill(sums_.begin(), sums_.end(), 0.0F);
    for (int rail = 0; rail < BorderStrip::rails; ++rail) {
      const double shift_px = slope_of(s, slopes) * layout_.offset_px(rail);
      const int shift = static_cast<int>(std::lround(shift_px / layout_.column_px));
      const float* const in = steps.data() + static_cast<std::ptrdiff_t>(rail) * n + shift;
      float* const sum = sums_.data();
      const int end = std::min(n, n - shift);
      for (int i = std::max(0, -shift); i < end; ++i)
        sum[i] += in[i];
    }
    for (std::size_t i = 0; i < sums_.size(); ++i) {
      const bool better = sums_[i] > best_[i];
      best_[i] = better ? sums_[i] : best_[i];
      best_slope_[i] = better ? s : best_slope_[i];
    }
  }
  peaks.clear();
  while (peaks.size() < peaks.capacity()) {
    const auto highest = std::max_element(best_.begin(), best_.end());
    const float strength = *highest / BorderStrip::rails;
    if (strength < least_edge) return;
    const auto column = static_cast<int>(highest - best_.begin());
    peaks.push_back({column, slope_of(best_slope_[static_cast<std::size_t>(column)], slopes), strength});
    const int last = std::min(n - 1, column + apart_columns);
    for (int i = std::max(0, column - apart_columns); i <= last; ++i)
      best_[static_cast<std::size_t>(i)] = 0;
  }
}

double CrossingFinder::foreground_between(const std::vector<float>& foreground, const Peak& left,
                                          const Peak& right) const {
  const int n = layout_.columns;
  double share = 0;
  for (int rail = 0; rail < rails_between; ++rail) {
    const double offset = layout_.offset_px(rail) / layout_.column_px;
    const int first = std::max(0, left.column + static_cast<int>(left.slope * offset) + 2);
    const int last = std::min(n - 1, right.column + static_cast<int>(right.slope * offset) - 2);
    if (last - first < 2) continue;
    const float* const row = foreground.data() + static_cast<std::ptrdiff_t>(rail) * n;
    int covered = 0;
    for (int i = first; i < last; ++i)
      covered += row[i] > is_foreground ? 1 : 0;
    share += static_cast<double>(covered) / (last - first);
  }
  return share / rails_between;
}

// From the picture itself: the largest step of colour near the edge, in rows along its length, to parts of a pixel.
FingerEdge CrossingFinder::refined(const Peak& peak, const cv::Mat& bgr, const BorderCurve& border) const {
  constexpr int reach = 6;  // columns to each side
  constexpr int mean = 3;   // columns and rows that are averaged on each side of a step
  constexpr int row_step = 3;
  std::array<double, 64> v;
  std::array<double, 64> u;
  std::size_t n = 0;
  const double at_border_px = layout_.column_centre_px(peak.column);
  const FingerEdge coarse{at_border_px, border.v_at(at_border_px), peak.slope};
  const int length = static_cast<int>(-layout_.offset_px(BorderStrip::rails - 1));
  for (int offset = -length; offset < 0 && n < v.size(); offset += row_step) {
    const auto row = static_cast<int>(std::lround(coarse.v_px + offset));
    const auto middle = static_cast<int>(std::lround(coarse.u_at(row)));
    if (row < 1 || row > bgr.rows - 2 || middle < reach + mean || middle >= bgr.cols - reach - mean) continue;
    std::array<double, 2 * reach + 1> step;
    std::size_t best = 0;
    for (std::size_t i = 0; i < step.size(); ++i) {
      const int column = middle - reach + static_cast<int>(i);
      int difference[3] = {0, 0, 0};
      for (int dv = -1; dv <= 1; ++dv) {
        const auto* const pixel = bgr.ptr<cv::Vec3b>(row + dv) + column;
        for (int k = 1; k <= mean; ++k) {
          for (int c = 0; c < 3; ++c)
            difference[c] += pixel[k][c] - pixel[-k][c];
        }
      }
      step[i] = std::abs(difference[0]) + std::abs(difference[1]) + std::abs(difference[2]);
      if (step[i] > step[best]) best = i;
    }
    double part = 0;
    if (best > 0 && best + 1 < step.size()) {
      const double bend = step[best - 1] - 2 * step[best] + step[best + 1];
      if (bend < 0) part = 0.5 * (step[best - 1] - step[best + 1]) / bend;
    }
    v[n] = row;
    u[n] = middle - reach + static_cast<double>(best) + part;
    ++n;
  }
  constexpr std::size_t fewest = 6;
  return n < fewest ? coarse : robust_line(v, u, n);
}

const Crossings& CrossingFinder::find(const std::vector<float>& foreground, const cv::Mat& bgr,
                                      const BorderCurve& border) {
  crossings_.clear();
  find_steps(foreground);
  Peaks lefts;
  Peaks rights;
  find_edges(rises_, lefts);
  find_edges(falls_, rights);

  struct Pair {
    double strength;
    Peak left;
    Peak right;
  };
  boost::container::static_vector<Pair, most_edges * most_edges> pairs;
  const double scale = layout_.image.width_px / 1280.0;
  for (const Peak& left : lefts) {
    for (const Peak& right : rights) {
      const double width_px = (right.column - left.column) * layout_.column_px;
      const double taper = std::abs(left.slope - right.slope);
      if (width_px < narrowest_px * scale || width_px > widest_px * scale || taper > largest_taper) continue;
      const double between = foreground_between(foreground, left, right);
      const double strength = static_cast<double>(left.strength + right.strength) + 2 * between - taper;
      if (between >= least_foreground && strength >= least_strength) pairs.push_back({strength, left, right});
    }
  }
  std::sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) { return a.strength > b.strength; });
  const double deepest_px = layout_.offset_px(BorderStrip::rails - 1);
  for (const Pair& pair : pairs) {
    if (crossings_.size() == crossings_.capacity()) break;
    Crossing found{{}, {}, pair.strength, 0, 0};
    const auto reach = [&](const Peak& peak) {
      return static_cast<int>(std::lround(peak.slope * deepest_px / layout_.column_px));
    };
    found.first_column = std::max(0, pair.left.column + std::min(0, reach(pair.left)));
    found.last_column = std::min(layout_.columns - 1, pair.right.column + std::max(0, reach(pair.right)));
    const double left_px = layout_.column_centre_px(pair.left.column);
    const double right_px = layout_.column_centre_px(pair.right.column);
    const bool overlaps = std::any_of(crossings_.begin(), crossings_.end(), [&](const Crossing& other) {
      const double v = border.v_at(0.5 * (left_px + right_px));
      constexpr double touching_px = 6;
      return right_px > other.left.u_at(v) + touching_px && left_px < other.right.u_at(v) - touching_px;
    });
    if (overlaps) continue;
    found.left = refined(pair.left, bgr, border);
    found.right = refined(pair.right, bgr, border);
    crossings_.push_back(found);
  }
  return crossings_;
}

}  // namespace telehug
