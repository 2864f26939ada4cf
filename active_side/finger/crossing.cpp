// SPDX-License-Identifier: Apache-2.0
#include "finger/crossing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace telehug {
namespace {

constexpr double steepest = 0.9;
constexpr double slope_step = 2 * steepest / (CrossingFinder::slopes - 1);
constexpr float step_unit = 1.0F / 32;  // of a step of the foreground, in standard deviations
constexpr float least_edge = 1;         // mean step of an edge, in standard deviations
constexpr float most_against = -1;      // how much a rail with the opposite step counts against an edge
constexpr float far_enough = 5;         // steps beyond this are all alike: skin colours make no difference
constexpr float is_foreground = 2;
constexpr int rails_between = 10;  // from the border on, looked at for foreground between two edges
constexpr double least_foreground = 0.75;
constexpr double largest_taper = 0.65;  // difference of two edges' slopes
constexpr double narrowest_px = 25;     // in a picture 1280 columns wide: 7 mm at the far end of a 340 mm high screen
constexpr double widest_px = 190;       // 20 mm close to the camera
constexpr int apart_columns = 3;        // two peaks of one edge

double slope_of(std::size_t index) {
  return -steepest + slope_step * static_cast<double>(index);
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
      margin_(shift(-steepest, BorderStrip::rails - 1) + 1),
      row_(static_cast<std::size_t>(layout.columns + 2 * margin_)),
      rises_(row_ * BorderStrip::rails),
      falls_(rises_.size()),
      sums_(static_cast<std::size_t>(layout.columns)),
      best_(sums_.size()),
      best_slope_(sums_.size()) {
  candidates_.reserve(sums_.size());
}

int CrossingFinder::shift(double slope, int rail) const noexcept {
  return static_cast<int>(std::lround(slope * layout_.offset_px(rail) / layout_.column_px));
}

// The picture's sides end a finger as well as its own edges do.
void CrossingFinder::find_steps(const std::vector<float>& foreground) {
  const int n = layout_.columns;
  for (int rail = 0; rail < BorderStrip::rails; ++rail) {
    const float* const in = foreground.data() + static_cast<std::ptrdiff_t>(rail) * n;
    Step* const rise = rises_.data() + first_of(rail);
    Step* const fall = falls_.data() + first_of(rail);
    const auto set = [&](int i, float before, float after) {
      const float step = std::min(after, far_enough) - std::min(before, far_enough);
      rise[i] = static_cast<Step>(std::max(step, most_against) / step_unit);
      fall[i] = static_cast<Step>(std::max(-step, most_against) / step_unit);
    };
    set(0, 0, in[1]);
    for (int i = 1; i + 1 < n; ++i)
      set(i, in[i - 1], in[i + 1]);
    set(n - 1, in[n - 2], 0);
  }
}

void CrossingFinder::find_edges(const Steps& steps, Peaks& peaks) {
  const int n = layout_.columns;
  std::fill(best_.begin(), best_.end(), Step{0});
  for (std::size_t slope = 0; slope < slopes; ++slope) {
    std::fill(sums_.begin(), sums_.end(), Step{0});
    constexpr int at_once = 4;  // rails
    static_assert(BorderStrip::rails % at_once == 0);
    for (int rail = 0; rail < BorderStrip::rails; rail += at_once) {
      const auto row = [&](int r) { return steps.data() + first_of(r) + shift(slope_of(slope), r); };
      const Step* const a = row(rail);
      const Step* const b = row(rail + 1);
      const Step* const c = row(rail + 2);
      const Step* const d = row(rail + 3);
      Step* const sum = sums_.data();
      for (int i = 0; i < n; ++i)
        sum[i] = static_cast<Step>(sum[i] + a[i] + b[i] + c[i] + d[i]);
    }
    for (std::size_t i = 0; i < sums_.size(); ++i) {
      const bool better = sums_[i] > best_[i];
      best_[i] = better ? sums_[i] : best_[i];
      best_slope_[i] = better ? static_cast<Step>(slope) : best_slope_[i];
    }
  }
  candidates_.clear();
  for (int i = 0; i < n; ++i) {
    const float strength = mean_step(best_[static_cast<std::size_t>(i)]);
    if (strength >= least_edge)
      candidates_.push_back(
          {i, slope_of(static_cast<std::size_t>(best_slope_[static_cast<std::size_t>(i)])), strength});
  }
  peaks.clear();
  while (!candidates_.empty() && peaks.size() < peaks.capacity()) {
    const Peak highest = *std::max_element(candidates_.begin(), candidates_.end(),
                                           [](const Peak& x, const Peak& y) { return x.strength < y.strength; });
    std::erase_if(candidates_,
                  [&](const Peak& peak) { return std::abs(peak.column - highest.column) <= apart_columns; });
    peaks.push_back(between_slopes(steps, highest));
  }
}

float CrossingFinder::mean_step(int sum) noexcept {
  return static_cast<float>(sum) * (step_unit / BorderStrip::rails);
}

// The best of the slopes beside a peak's, at its place or next to it.
CrossingFinder::Peak CrossingFinder::between_slopes(const Steps& steps, const Peak& peak) const {
  Peak best = peak;
  for (const double slope : {peak.slope - 0.5 * slope_step, peak.slope + 0.5 * slope_step}) {
    if (std::abs(slope) > steepest) continue;
    for (int column = std::max(0, peak.column - 2); column <= std::min(layout_.columns - 1, peak.column + 2);
         ++column) {
      int sum = 0;
      for (int rail = 0; rail < BorderStrip::rails; ++rail)
        sum += steps[static_cast<std::size_t>(first_of(rail) + column + shift(slope, rail))];
      if (mean_step(sum) > best.strength) best = {column, slope, mean_step(sum)};
    }
  }
  return best;
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
    // Interleaved channels of all columns that count, three rows together; then the steps at 2 reach + 1 of them.
    constexpr int places = 2 * reach + 1;
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
      step[i] = difference[3 * i] + difference[3 * i + 1] + difference[3 * i + 2];
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
      const double edges = static_cast<double>(left.strength + right.strength) - taper;
      if (edges + 2 < least_strength) continue;
      const double between = foreground_between(foreground, left, right);
      const double strength = edges + 2 * between;
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
