// SPDX-License-Identifier: Apache-2.0
//
// The outline of a fingertip, to parts of a pixel. About a point inside the tip the outline is one distance for every
// angle; dynamic programming finds the closed-in path that has the finger's colours within, other colours beyond, edges
// along it, and no jumps (a star-convex segmentation with region and edge terms, exact for its cost).
#pragma once

#include <array>
#include <cstddef>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "common/units.hpp"
#include "finger/finger_colours.hpp"
#include "finger/tip_search.hpp"

namespace telehug {

struct TipContour {
  static constexpr std::size_t angles = 51;  // 4 degrees apart, -100 to 100 from the direction towards the tip
  std::array<ImagePoint, angles> points;
  std::array<float, angles> edge;  // strength of the edge at each, 0 to 1
  double score = 0;                // mean gain: the higher the surer
};

class TipContourFinder {
 public:
  TipContourFinder();

  // Of the guesses the one with the surest outline. `guesses` has at least one. Allocates nothing.
  [[nodiscard]] TipContour find(const cv::Mat& bgr, const TipSearch::Guesses& guesses, FingerColours& colours);

 private:
  struct Centre {
    double u = 0;
    double v = 0;
    double half_width_px = 0;
  };
  struct Grid {
    std::size_t angle_step = 1;  // 1: all angles; 2: every second
    double radius_step_px = 1;
  };

  // A guess, its outline, and about which point that was traced.
  struct Look {
    Centre centre;
    TipContour contour;
    double guess_sureness = 0;
    [[nodiscard]] double sureness() const noexcept { return contour.score + guess_sureness; }
  };

  Look first_look(const cv::Mat& bgr, const TipGuess& guess, FingerColours& colours);
  TipContour close_look(const cv::Mat& bgr, const Look& look, FingerColours& colours);
  [[nodiscard]] std::size_t outer_edge(std::size_t row, std::size_t inner, std::size_t last) const;
  TipContour trace(const cv::Mat& bgr, const Centre& centre, const Grid& grid, FingerColours& colours);
  void sample_ray(const cv::Mat& bgr, const Centre& centre, const Grid& grid, std::size_t angle, std::size_t radii);
  void learn_tip(const cv::Mat& bgr, const Centre& centre, const std::array<double, TipContour::angles>& radius,
                 bool guessed, FingerColours& colours);

  static constexpr std::size_t most_radii = 160;
  std::vector<Colour> ray_;  // colours along one angle, with a margin at both ends
  std::vector<float> log_radius_;
  std::vector<float> edge_;  // angles by radii
  std::vector<float> sharp_;
  std::vector<float> like_;
  std::vector<float> cost_;
  std::vector<float> path_cost_;
  std::vector<std::uint8_t> came_from_;
  std::vector<Colour> inside_;
};

}  // namespace telehug
