// SPDX-License-Identifier: Apache-2.0
//
// Where along a finger its tip may be: outlines of fingertips of several lengths are laid over the edge map at every
// place along the finger's axis.
#pragma once

#include <boost/container/static_vector.hpp>
#include <cstddef>
#include <vector>

#include "finger/edge_map.hpp"
#include "finger/finger_axis.hpp"

namespace telehug {

struct TipGuess {
  double tip_v = 0;   // row of the foremost point
  double root_u = 0;  // middle of the outline where the straight finger ends and its tip begins
  double root_v = 0;
  double finger_half_width_px = 0;  // behind the tip
  double lean = 0;                  // of the tip: columns to the right per row towards the tip
  double strength = 0;
};

class TipSearch {
 public:
  TipSearch();

  static constexpr std::size_t most_guesses = 3;
  using Guesses = boost::container::static_vector<TipGuess, most_guesses>;

  // The strongest first, no two closer than a few rows; from a little in front of the border to `last_v`. Allocates
  // nothing.
  [[nodiscard]] Guesses find(const EdgeMap& edges, const FingerAxis& axis, double last_v, double scale) const;

 private:
  // In half widths; x across, y towards the tip, from the root on; (nx, ny) the normal.
  struct OutlinePoint {
    double x = 0;
    double y = 0;
    double nx = 0;
    double ny = 0;
  };
  struct Outline {
    std::vector<OutlinePoint> points;
    double length = 0;
  };

  [[nodiscard]] TipGuess best_at(const EdgeMap& edges, const FingerAxis& axis, double tip_v) const;

  std::vector<Outline> outlines_;
};

}  // namespace telehug
