// SPDX-License-Identifier: Apache-2.0
//
// Finds who crosses the screen's bottom edge: in the border strip a finger is a band of foreground between two nearly
// straight edges, a left one where foreground begins and a right one where it ends. Both are found like lines by Hough:
// the steps of the foreground along all rails are summed up for every place and inclination.
#pragma once

#include <boost/container/static_vector.hpp>
#include <cstddef>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "calibration/border_curve.hpp"
#include "common/messages.hpp"
#include "finger/border_strip.hpp"

namespace telehug {

// A straight edge in the picture: u = u_px + slope (v - v_px).
struct FingerEdge {
  double u_px = 0;
  double v_px = 0;
  double slope = 0;

  [[nodiscard]] double u_at(double v) const noexcept { return u_px + slope * (v - v_px); }
};

struct Crossing {
  FingerEdge left;
  FingerEdge right;
  double strength = 0;   // of both edges and of the foreground between them; from least_strength on
  int first_column = 0;  // cells of the strip that it covers, at any rail
  int last_column = 0;
};

using Crossings = boost::container::static_vector<Crossing, max_contacts>;

class CrossingFinder {
 public:
  // Sum of the two edges' mean steps in standard deviations (each up to 5) and twice the share of foreground between
  // them. Shadows and specks that were seen stay below 3.5, fingers of skin that is like what lies behind above 5.
  static constexpr double least_strength = 4.5;
  static constexpr std::size_t slopes = 19;  // looked at, from -0.9 to 0.9; then those halfway between

  explicit CrossingFinder(const BorderStrip::Layout& layout);

  // `foreground` is what BackgroundStrip::distance() says of `bgr`'s strip. From the strongest on, no two overlap. The
  // result lives until the next call. Allocates nothing.
  const Crossings& find(const std::vector<float>& foreground, const cv::Mat& bgr, const BorderCurve& border);

 private:
  static constexpr std::size_t most_edges = 24;
  struct Peak {
    int column = 0;
    double slope = 0;
    float strength = 0;  // mean step over the rails, in standard deviations
  };
  using Peaks = boost::container::static_vector<Peak, most_edges>;
  // Fixed point, so that sums over all rails fit as well. Rails by columns, with a margin of zeros at both sides.
  using Step = std::int16_t;
  using Steps = std::vector<Step>;

  void find_steps(const std::vector<float>& foreground);
  void find_edges(const Steps& steps, Peaks& peaks);
  [[nodiscard]] static float mean_step(int sum) noexcept;
  [[nodiscard]] Peak between_slopes(const Steps& steps, const Peak& peak) const;
  [[nodiscard]] double foreground_between(const std::vector<float>& foreground, const Peak& left,
                                          const Peak& right) const;
  [[nodiscard]] FingerEdge refined(const Peak& peak, const cv::Mat& bgr, const BorderCurve& border) const;
  // Of an edge from the border to a rail, in columns.
  [[nodiscard]] int shift(double slope, int rail) const noexcept;
  // Where a rail's first column stands in Steps.
  [[nodiscard]] std::ptrdiff_t first_of(int rail) const noexcept {
    return rail * static_cast<std::ptrdiff_t>(row_) + margin_;
  }

  BorderStrip::Layout layout_;
  int margin_;       // of Steps, in columns
  std::size_t row_;  // of Steps: columns and both margins
  Steps rises_;      // of the foreground at each cell
  Steps falls_;
  std::vector<Step> sums_;  // of one slope
  std::vector<Step> best_;
  std::vector<Step> best_slope_;
  std::vector<Peak> candidates_;
  Crossings crossings_;
};

}  // namespace telehug
