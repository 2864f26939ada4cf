// SPDX-License-Identifier: Apache-2.0
//
// Finds who crosses the screen's bottom edge: in the border strip a finger is a band of foreground between two nearly
// straight edges, a left one where foreground begins and a right one where it ends. Both are found like lines by Hough:
// the steps of the foreground along all rails are summed up for every place and inclination.
#pragma once

#include <boost/container/static_vector.hpp>
#include <cstddef>
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

  explicit CrossingFinder(const BorderStrip::Layout& layout);

  // `foreground` is what BackgroundStrip::distance() says of `bgr`'s strip. From the strongest on, no two overlap. The
  // result lives until the next call. Allocates nothing.
  const Crossings& find(const std::vector<float>& foreground, const cv::Mat& bgr, const BorderCurve& border);

 private:
  static constexpr int slopes = 37;  // from -0.9 to 0.9
  static constexpr std::size_t most_edges = 24;
  struct Peak {
    int column = 0;
    double slope = 0;
    float strength = 0;
  };
  using Peaks = boost::container::static_vector<Peak, most_edges>;

  void find_steps(const std::vector<float>& foreground);
  void find_edges(const std::vector<float>& steps, Peaks& peaks);
  [[nodiscard]] double foreground_between(const std::vector<float>& foreground, const Peak& left,
                                          const Peak& right) const;
  [[nodiscard]] FingerEdge refined(const Peak& peak, const cv::Mat& bgr, const BorderCurve& border) const;

  BorderStrip::Layout layout_;
  std::vector<float> rises_;  // of the foreground at each cell, in standard deviations; rails by columns
  std::vector<float> falls_;
  std::vector<float> sums_;  // of one slope
  std::vector<float> best_;
  std::vector<int> best_slope_;
  Crossings crossings_;
};

}  // namespace telehug
