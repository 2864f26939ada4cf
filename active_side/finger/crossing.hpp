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
#include "finger/finger_edge.hpp"

namespace telehug {

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
  // The sum of the two edges' mean steps in standard deviations (each up to 5), twice the share of foreground between
  // them, less what speaks against a finger: foreground beside it, edges that are not parallel.
  static constexpr double least_strength = 4.5;

  explicit CrossingFinder(const BorderStrip::Layout& layout);

  // `foreground` and `new_edges` are what BackgroundStrip says of `bgr`'s strip. From the strongest on, no two overlap.
  // The result lives until the next call. Allocates nothing.
  const Crossings& find(const std::vector<float>& foreground, const std::vector<float>& new_edges, const cv::Mat& bgr,
                        const BorderCurve& border);

 private:
  static constexpr int slopes = 27;  // from -1.56 to 1.56
  static constexpr std::size_t most_edges = 28;
  struct Peak {
    int column = 0;
    double slope = 0;
    float strength = 0;  // mean step over the rails, in standard deviations
  };
  struct Pair {
    double strength = 0;
    Peak left;
    Peak right;
  };
  static constexpr std::size_t max_pairs = most_edges * most_edges;
  using Pairs = boost::container::static_vector<Pair, max_pairs>;
  using Peaks = boost::container::static_vector<Peak, most_edges>;

  // Fixed point, so that weighted sums over all rails fit as well. Rails by columns, with a margin of zeros at both
  // sides.
  using Step = std::int16_t;
  using Steps = std::vector<Step>;

  static void choose(Pairs& pairs);
  void find_steps(const std::vector<float>& foreground, const std::vector<float>& new_edges);
  void add_rails(const Steps& steps, double slope, int first_rail, int end_rail);
  void find_edges(const Steps& steps, Peaks& peaks);
  // On the rails next to the border, between columns given there with the slopes of edges.
  [[nodiscard]] double foreground_share(const std::vector<float>& foreground, double from, double from_slope, double to,
                                        double to_slope) const;

  // Of an edge from the border to a rail, in columns.
  [[nodiscard]] int shift(double slope, int rail) const noexcept;
  // Where a rail's first column stands in Steps.
  [[nodiscard]] std::ptrdiff_t first_of(int rail) const noexcept {
    return rail * static_cast<std::ptrdiff_t>(row_) + margin_;
  }

  BorderStrip::Layout layout_;
  int margin_;        // of Steps, in columns
  std::size_t row_;   // of Steps: columns and both margins
  Steps left_steps_;  // how much each cell looks like a finger's left edge
  Steps right_steps_;
  Steps sums_;  // of one slope; a row without margins, as the next ones
  Steps best_;  // weighted
  Steps best_slope_;
  std::vector<Peak> candidates_;
  Crossings crossings_;
};

}  // namespace telehug
