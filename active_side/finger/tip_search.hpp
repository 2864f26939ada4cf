// SPDX-License-Identifier: Apache-2.0
//
// Where along a finger its tip may be: outlines of fingertips of several lengths are laid over the edge map at every
// place along the finger's axis; first a few of them at every other place, then all about the best places.
#pragma once

#include <boost/container/static_vector.hpp>
#include <cstddef>
#include <span>
#include <vector>

#include "common/units.hpp"
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
  explicit TipSearch(ImageSize largest);

  static constexpr std::size_t most_guesses = 3;
  using Guesses = boost::container::static_vector<TipGuess, most_guesses>;

  // The strongest first, no two closer than a few rows; from a little in front of the border to `last_v`, a row of the
  // picture. Allocates nothing.
  [[nodiscard]] Guesses find(const EdgeMap& edges, const FingerAxis& axis, double last_v, double scale);

 private:
  // In half widths; x across, y towards the tip, from the root on; (nx, ny) the normal.
  struct OutlinePoint {
    float x = 0;
    float y = 0;
    float nx = 0;
    float ny = 0;
  };
  struct Outline {
    std::vector<OutlinePoint> points;
    double length = 0;
  };
  // Sums, over the rows before each, of how strong the straight finger's sides are.
  struct Sides {
    double exact = 0;
    double nearly = 0;  // up to two pixels beside
  };
  // Of an outline on the finger.
  struct Place {
    double half_width_px = 0;
    double evidence_beside = 0;  // from the finger's sides behind the tip and beyond it
  };
  // Which outlines are laid on a place.
  struct Look {
    std::span<const double> widths;
    std::span<const double> leans;
    std::size_t point_step = 1;  // 2: by every second of their points
  };

  void sum_sides(const EdgeMap& edges, const FingerAxis& axis, double last_v);
  // Mean strength between two rows.
  [[nodiscard]] double mean_side(double Sides::*kind, double first_v, double last_v) const;
  [[nodiscard]] Place place(const Outline& outline, const FingerAxis& axis, double tip_v) const;
  [[nodiscard]] static TipGuess laid_over(const EdgeMap& edges, const Outline& outline, const Place& place,
                                          TipGuess guess, double width, std::size_t point_step);
  [[nodiscard]] TipGuess best_at(const EdgeMap& edges, const FingerAxis& axis, double tip_v, const Look& look) const;

  std::vector<Outline> outlines_;
  std::vector<Sides> sides_;  // for every second row of the picture
  std::size_t last_sum_ = 0;
};

}  // namespace telehug
