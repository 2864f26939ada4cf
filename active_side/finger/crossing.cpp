// SPDX-License-Identifier: Apache-2.0
#include "finger/crossing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace telehug {
namespace {

constexpr double steepest = 1.56;          // 57 degrees from straight across the border
constexpr float least_edge = 0.9F;         // mean step of an edge, in standard deviations
constexpr float most_against = -1;         // how much a rail with the opposite step counts against an edge
constexpr float far_enough = 5;            // steps beyond this are all alike: skin colours make no difference
constexpr float edge_without_step = 0.4F;  // worth of an edge whose sides differ from the background alike
// Worth of a step on an edge that is seen on the bezel only, and of one on all rails: 0.8 to 1 for the whole edges.
constexpr int near_weight = 8;
constexpr int all_weight = 5;
constexpr float step_unit = 1.0F / 32;  // of a step, in standard deviations
constexpr float is_foreground = 2;
constexpr double least_foreground = 0.5;
constexpr double foreground_weight = 2;
constexpr double beside_weight = 0.6;  // of foreground on either side: then this is only a part of a finger
constexpr int shared_columns = 3;      // an edge of two fingers, or of a finger and its shadow
constexpr double shared_margin = 1.0;  // of strength: less is the shadow
constexpr double of_a_finger = 4.3;    // strength that a second finger must bring to be believed
constexpr double beside_px = 14;
constexpr double largest_taper = 0.75;  // difference of two edges' slopes
constexpr double narrowest_px = 14;     // a long nail's tip, at the far end of a wide screen; in pictures 720 rows high
constexpr double widest_px = 190;       // a thumb, close to the camera
constexpr int apart_columns = 3;        // two peaks of one edge

double slope_of(int index, int slopes) {
  return -steepest + 2 * steepest * index / (slopes - 1);
}

float strength_of(int weighted_sum) {
  return static_cast<float>(weighted_sum) * (step_unit / (all_weight * BorderStrip::rails));
}

}  // namespace

CrossingFinder::CrossingFinder(const BorderStrip::Layout& layout)
    : layout_(layout),
      margin_(shift(-steepest, BorderStrip::rails - 1) + 1),
      row_(static_cast<std::size_t>(layout.columns + 2 * margin_)),
      left_steps_(row_ * BorderStrip::rails),
      right_steps_(left_steps_.size()),
      sums_(static_cast<std::size_t>(layout.columns)),
      best_(sums_.size()),
      best_slope_(sums_.size()) {
  candidates_.reserve(sums_.size());
}

int CrossingFinder::shift(double slope, int rail) const noexcept {
  return static_cast<int>(std::lround(slope * layout_.offset_px(rail) / layout_.column_px));
}

// The picture's sides end a finger as well as its own edges do.
void CrossingFinder::find_steps(const std::vector<float>& foreground, const std::vector<float>& new_edges) {
  const int n = layout_.columns;
  const auto fixed = [](float step) { return static_cast<Step>(step / step_unit); };
  for (int rail = 0; rail < BorderStrip::rails; ++rail) {
    const auto start = static_cast<std::ptrdiff_t>(rail) * n;
    const float* const in = foreground.data() + start;
    const float* const edge = new_edges.data() + start;
    Step* const left = left_steps_.data() + first_of(rail);
    Step* const right = right_steps_.data() + first_of(rail);
    for (int i = 1; i + 1 < n; ++i) {
      const float step = std::min(in[i + 1], far_enough) - std::min(in[i - 1], far_enough);
      const float highest = std::max(std::max(in[i - 1], in[i]), in[i + 1]);
      const float unsigned_step = highest > is_foreground ? edge_without_step * std::min(edge[i], far_enough) : 0.0F;
      const float least = std::max(unsigned_step, most_against);
      left[i] = fixed(std::max(step, least));
      right[i] = fixed(std::max(-step, least));
    }
    left[0] = fixed(std::min(in[0], far_enough));
    right[n - 1] = fixed(std::min(in[n - 1], far_enough));
    left[n - 1] = right[0] = 0;
    if (rail < BorderStrip::near_rails) continue;
    // Slopes are tried in steps that miss a far rail's cell by one.
    for (Step* const steps : {left, right}) {
      std::copy_n(steps, n, sums_.begin());
      const Step* const narrow = sums_.data();
      for (int i = 1; i + 1 < n; ++i)
        steps[i] = std::max(std::max(narrow[i - 1], narrow[i]), narrow[i + 1]);
    }
  }
}

// Of all rails from `first_rail` to before `end_rail`, four at once.
void CrossingFinder::add_rails(const Steps& steps, double slope, int first_rail, int end_rail) {
  constexpr int at_once = 4;
  static_assert(BorderStrip::rails % at_once == 0 && BorderStrip::near_rails % at_once == 0);
  for (int rail = first_rail; rail < end_rail; rail += at_once) {
    const auto row = [&](int r) { return steps.data() + first_of(r) + shift(slope, r); };
    const Step* const a = row(rail);
    const Step* const b = row(rail + 1);
    const Step* const c = row(rail + 2);
    const Step* const d = row(rail + 3);
    Step* const sum = sums_.data();
    for (int i = 0; i < layout_.columns; ++i)
      sum[i] = static_cast<Step>(sum[i] + a[i] + b[i] + c[i] + d[i]);
  }
}

void CrossingFinder::find_edges(const Steps& steps, Peaks& peaks) {
  std::fill(best_.begin(), best_.end(), Step{0});
  for (int s = 0; s < slopes; ++s) {
    const auto keep_best = [&](int weight) {
      for (std::size_t i = 0; i < sums_.size(); ++i) {
        const auto strength = static_cast<Step>(weight * sums_[i]);
        const bool better = strength > best_[i];
        best_[i] = better ? strength : best_[i];
        best_slope_[i] = better ? static_cast<Step>(s) : best_slope_[i];
      }
    };
    const double slope = slope_of(s, slopes);
    std::fill(sums_.begin(), sums_.end(), Step{0});
    add_rails(steps, slope, 0, BorderStrip::near_rails);
    keep_best(near_weight);
    add_rails(steps, slope, BorderStrip::near_rails, BorderStrip::rails);
    keep_best(all_weight);
  }
  candidates_.clear();
  for (int i = 0; i < layout_.columns; ++i) {
    const auto column = static_cast<std::size_t>(i);
    const float strength = strength_of(best_[column]);
    if (strength >= least_edge) candidates_.push_back({i, slope_of(best_slope_[column], slopes), strength});
  }
  peaks.clear();
  while (!candidates_.empty() && peaks.size() < peaks.capacity()) {
    const Peak highest = *std::max_element(candidates_.begin(), candidates_.end(),
                                           [](const Peak& x, const Peak& y) { return x.strength < y.strength; });
    peaks.push_back(highest);
    std::erase_if(candidates_,
                  [&](const Peak& peak) { return std::abs(peak.column - highest.column) <= apart_columns; });
  }
}

double CrossingFinder::foreground_share(const std::vector<float>& foreground, double from, double from_slope, double to,
                                        double to_slope) const {
  const int n = layout_.columns;
  double share = 0;
  int rails = 0;
  for (int rail = 0; rail < BorderStrip::near_rails; ++rail) {
    const double offset = layout_.offset_px(rail) / layout_.column_px;
    const int first = std::max(0, static_cast<int>(std::lround(from + from_slope * offset)));
    const int last = std::min(n - 1, static_cast<int>(std::lround(to + to_slope * offset)));
    if (last < first) continue;
    const float* const row = foreground.data() + static_cast<std::ptrdiff_t>(rail) * n;
    int covered = 0;
    for (int i = first; i <= last; ++i)
      covered += row[i] > is_foreground ? 1 : 0;
    share += static_cast<double>(covered) / (last - first + 1);
    ++rails;
  }
  return rails > 0 ? share / rails : 0;
}

// The pairs that do not overlap and together are worth most: one finger, or two with a gap between their inner edges.
void CrossingFinder::choose(Pairs& pairs) {
  std::sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) { return a.right.column < b.right.column; });
  std::array<double, max_pairs + 1> worth;  // of the best choice among the first n
  std::array<std::size_t, max_pairs> rest;  // how many pairs lie wholly to the left of this one
  std::array<bool, max_pairs> taken;
  worth[0] = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    std::size_t n = i;
    while (n > 0 && pairs[n - 1].right.column > pairs[i].left.column)
      --n;
    rest[i] = n;
    const double with = worth[n] + pairs[i].strength - of_a_finger;
    taken[i] = with > worth[i];
    worth[i + 1] = std::max(with, worth[i]);
  }
  Pairs chosen;
  for (std::size_t i = pairs.size(); i > 0;) {
    if (taken[i - 1]) {
      chosen.push_back(pairs[i - 1]);
      i = rest[i - 1];
    } else {
      --i;
    }
  }
  std::sort(chosen.begin(), chosen.end(), [](const Pair& a, const Pair& b) { return a.strength > b.strength; });
  // What shares an edge with a clearer finger is its shadow, or a strip of it.
  pairs.clear();
  for (const Pair& pair : chosen) {
    const bool part = std::any_of(pairs.begin(), pairs.end(), [&](const Pair& clearer) {
      const int apart = std::min(std::abs(pair.left.column - clearer.right.column),
                                 std::abs(clearer.left.column - pair.right.column));
      return apart <= shared_columns && pair.strength < clearer.strength - shared_margin;
    });
    if (!part) pairs.push_back(pair);
  }
}

const Crossings& CrossingFinder::find(const std::vector<float>& foreground, const std::vector<float>& new_edges,
                                      const cv::Mat& bgr, const BorderCurve& border) {
  crossings_.clear();
  find_steps(foreground, new_edges);
  Peaks lefts;
  Peaks rights;
  find_edges(left_steps_, lefts);
  find_edges(right_steps_, rights);

  Pairs pairs;
  const double beside = beside_px * layout_.scale / layout_.column_px;
  for (const Peak& left : lefts) {
    for (const Peak& right : rights) {
      const double width_px = (right.column - left.column) * layout_.column_px;
      const double taper = std::abs(left.slope - right.slope);
      if (width_px < narrowest_px * layout_.scale || width_px > widest_px * layout_.scale || taper > largest_taper) {
        continue;
      }
      const double edges = static_cast<double>(left.strength + right.strength) - taper;
      if (edges + foreground_weight < least_strength) continue;
      const double between = foreground_share(foreground, left.column + 1, left.slope, right.column - 1, right.slope);
      if (between < least_foreground) continue;
      const double outside =
          foreground_share(foreground, left.column - beside, left.slope, left.column - 2, left.slope) +
          foreground_share(foreground, right.column + 2, right.slope, right.column + beside, right.slope);
      const double strength = edges + foreground_weight * between - beside_weight * outside;
      if (strength >= least_strength) pairs.push_back({strength, left, right});
    }
  }
  choose(pairs);
  const double deepest_px = layout_.offset_px(BorderStrip::rails - 1);
  for (const Pair& pair : pairs) {
    if (crossings_.size() == crossings_.capacity()) break;
    Crossing found{{}, {}, pair.strength, 0, 0};
    const auto coarse = [&](const Peak& peak) {
      const double u_px = layout_.column_centre_px(peak.column);
      return FingerEdge{u_px, border.v_at(u_px), peak.slope};
    };
    const auto reach = [&](const Peak& peak) {
      return static_cast<int>(std::lround(peak.slope * deepest_px / layout_.column_px));
    };
    found.first_column = std::max(0, pair.left.column + std::min(0, reach(pair.left)));
    found.last_column = std::min(layout_.columns - 1, pair.right.column + std::max(0, reach(pair.right)));
    const double left_px = layout_.column_centre_px(pair.left.column);
    const double right_px = layout_.column_centre_px(pair.right.column);
    found.left = follow_edge(bgr, coarse(pair.left), layout_.scale);
    found.right = follow_edge(bgr, coarse(pair.right), layout_.scale);
    const double middle_v = border.v_at(0.5 * (left_px + right_px));
    if (found.right.u_at(middle_v) - found.left.u_at(middle_v) < narrowest_px * layout_.scale) continue;
    crossings_.push_back(found);
  }
  return crossings_;
}

}  // namespace telehug
