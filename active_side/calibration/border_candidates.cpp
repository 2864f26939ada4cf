// SPDX-License-Identifier: Apache-2.0
#include "calibration/border_candidates.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <opencv2/imgproc.hpp>

namespace telehug {
namespace {

constexpr int blocks = 32;        // of columns; an edge is measured once in each
constexpr double sigma_px = 0.5;  // of such a measurement: noise, and what bends the edge beyond a parabola
// Bezels are 15 to 20 rows high in pictures of 720; the mirror image of one is as high.
constexpr double searched_part_of_height = 1 / 18.0;
// An edge that is seen in fewer blocks is a scratch or a shadow.
constexpr std::size_t least_blocks = 13;
constexpr double inlier_px = 1.5;

// One edge in one block of columns.
struct Edgel {
  double t;  // -1..1 over the picture's width
  double v_px;
  double step;  // grey levels per row; > 0: brighter below
};

struct Curve {
  double level_px;
  double slope_px;  // per unit of t
  double bend_px;

  [[nodiscard]] double bent(double t) const { return slope_px * t + bend_px * t * t; }
};

// The mean row-to-row profile of a block, along the line so that its slope does not blur it.
std::vector<float> profile(const cv::Mat& grey, const BorderLine& level, int first_column, int end_column, int reach) {
  std::vector<float> mean(static_cast<std::size_t>(2 * reach + 1), 0.0F);
  const auto columns = static_cast<float>(end_column - first_column);
  for (int u = first_column; u < end_column; ++u) {
    const double v0 = level.v_at(u) - reach;
    const int row = static_cast<int>(std::floor(v0));
    const auto part = static_cast<float>(v0 - row);
    for (int i = 0; i <= 2 * reach; ++i) {
      const int upper = std::clamp(row + i, 0, grey.rows - 1);
      const int lower = std::clamp(row + i + 1, 0, grey.rows - 1);
      const float value = (1 - part) * static_cast<float>(grey.at<std::uint8_t>(upper, u)) +
                          part * static_cast<float>(grey.at<std::uint8_t>(lower, u));
      mean[static_cast<std::size_t>(i)] += value / columns;
    }
  }
  return mean;
}

// Extremes of the profile's slope, above the noise, which is the median of the slope's size.
void add_edgels(const std::vector<float>& profile, double t, double first_row, std::vector<Edgel>& edgels) {
  constexpr double least_step = 0.4;
  constexpr double noise_factor = 2.5;
  std::vector<double> step(profile.size(), 0.0);
  for (std::size_t i = 2; i + 2 < profile.size(); ++i)
    step[i] = (2 * (profile[i + 1] - profile[i - 1]) + (profile[i + 2] - profile[i - 2])) / 8.0;
  std::vector<double> sizes(step.size());
  std::transform(step.begin(), step.end(), sizes.begin(), [](double s) { return std::abs(s); });
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  const double least = std::max(least_step, noise_factor * std::min(*middle, 1.0));
  for (std::size_t i = 3; i + 3 < step.size(); ++i) {
    const double before = std::abs(step[i - 1]), here = std::abs(step[i]), after = std::abs(step[i + 1]);
    const bool same_sign = step[i - 1] * step[i] > 0 && step[i + 1] * step[i] > 0;
    if (here < least || here < before || here <= after || !same_sign) continue;
    const double vertex = 0.5 * (before - after) / (before - 2 * here + after);
    edgels.push_back({t, first_row + static_cast<double>(i) + vertex, step[i]});
  }
}

double v_of(const BorderLine& level, double t, int columns) {
  return level.v_at(0.5 * (t + 1) * (columns - 1));
}

// The slope and bend that the edges share: those that gather most edgels on few levels.
Curve common_shape(const std::vector<Edgel>& edgels, int reach) {
  Curve best{0, 0, 0};
  double best_score = -1;
  const std::ptrdiff_t middle = 2 * std::ptrdiff_t{reach} + 20;
  std::vector<double> votes(static_cast<std::size_t>(2 * middle + 1));
  for (double bend = -10; bend <= 10; bend += 0.5) {
    for (double slope = -8; slope <= 8; slope += 0.5) {
      const Curve shape{0, slope, bend};
      std::fill(votes.begin(), votes.end(), 0.0);
      for (const Edgel& edgel : edgels) {
        const double level = edgel.v_px - shape.bent(edgel.t);
        const auto bin = std::lround(2 * level) + middle;
        if (bin < 1 || bin + 1 >= static_cast<std::ptrdiff_t>(votes.size())) continue;
        const double weight = std::min(std::abs(edgel.step), 4.0);
        votes[static_cast<std::size_t>(bin)] += weight;
        votes[static_cast<std::size_t>(bin - 1)] += 0.5 * weight;
        votes[static_cast<std::size_t>(bin + 1)] += 0.5 * weight;
      }
      const double score =
          std::accumulate(votes.begin(), votes.end(), 0.0, [](double sum, double v) { return sum + v * v; });
      if (score > best_score) {
        best_score = score;
        best = shape;
      }
    }
  }
  return best;
}

// The edgels of one sign nearest to a level, one a block at most.
std::vector<Edgel> members(const std::vector<Edgel>& edgels, const Curve& curve, bool brighter_below) {
  std::vector<Edgel> found;
  for (const Edgel& edgel : edgels) {
    const double off = std::abs(edgel.v_px - curve.bent(edgel.t) - curve.level_px);
    if ((edgel.step > 0) != brighter_below || off > inlier_px) continue;
    if (found.empty() || found.back().t != edgel.t) {
      found.push_back(edgel);
    } else if (off < std::abs(found.back().v_px - curve.bent(edgel.t) - curve.level_px)) {
      found.back() = edgel;
    }
  }
  return found;
}

double median_level(const std::vector<Edgel>& edgels, const Curve& curve) {
  std::vector<double> levels;
  levels.reserve(edgels.size());
  for (const Edgel& edgel : edgels)
    levels.push_back(edgel.v_px - curve.bent(edgel.t));
  const auto middle = levels.begin() + static_cast<std::ptrdiff_t>(levels.size() / 2);
  std::nth_element(levels.begin(), middle, levels.end());
  return *middle;
}

}  // namespace

std::vector<BorderCandidate> find_border_candidates(const cv::Mat& bgr, const BorderLine& level) {
  cv::Mat grey;
  cv::cvtColor(bgr, grey, cv::COLOR_BGR2GRAY);
  const int reach = std::max(12, static_cast<int>(std::lround(searched_part_of_height * bgr.rows)));

  // Edgels in rows relative to `level`, ordered by block.
  std::vector<Edgel> edgels;
  for (int block = 0; block < blocks; ++block) {
    const int first = block * bgr.cols / blocks;
    const int end = (block + 1) * bgr.cols / blocks;
    const double t = (first + end - 1.0) / (bgr.cols - 1) - 1;
    add_edgels(profile(grey, level, first, end, reach), t, -reach, edgels);
  }
  Curve curve = common_shape(edgels, reach);

  std::vector<BorderCandidate> candidates;
  std::vector<double> taken;
  for (double wanted = -reach; wanted <= reach; wanted += 0.5) {
    for (const bool brighter_below : {false, true}) {
      curve.level_px = wanted;
      std::vector<Edgel> found = members(edgels, curve, brighter_below);
      if (found.size() < least_blocks) continue;
      curve.level_px = median_level(found, curve);
      found = members(edgels, curve, brighter_below);
      const double signed_level = curve.level_px + (brighter_below ? 1e4 : 0);
      const bool known = std::any_of(taken.begin(), taken.end(),
                                     [&](double other) { return std::abs(other - signed_level) < inlier_px; });
      if (found.size() < least_blocks || known) continue;
      taken.push_back(signed_level);
      BorderCandidate candidate{{}, brighter_below, 0};
      for (const Edgel& edgel : found) {
        const double u = 0.5 * (edgel.t + 1) * (bgr.cols - 1);
        candidate.points.push_back({{u, edgel.v_px + v_of(level, edgel.t, bgr.cols)}, sigma_px});
        candidate.contrast += std::abs(edgel.step) / static_cast<double>(found.size());
      }
      candidates.push_back(std::move(candidate));
    }
  }
  return candidates;
}

}  // namespace telehug
