// SPDX-License-Identifier: Apache-2.0
//
// The finger detector of the thesis: one finger, found by its two edges on the bezel, followed by its colour onto the
// screen. It is the baseline that later detectors are measured against; facts/touch.md lists where it breaks (soft
// shadows, silver and white bezels, shaded hands, mirror images, hovering fingers, which it can't tell from touches).
//
// Numbers that the thesis does not give are the defaults of ThesisOptions.
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "calibration/border_line.hpp"
#include "common/units.hpp"
#include "finger/aligned_patch.hpp"
#include "finger/finger.hpp"
#include "finger/finger_colour.hpp"
#include "finger/finger_edges.hpp"

namespace telehug {

// Standard deviation of the tip's place in the picture, from what the solved rigs of both samples leave over.
inline constexpr double thesis_tip_sigma_px = 2;

struct ThesisOptions {
  // From the 4th row on, a row belongs to the finger only if more than 2/3 of the pixels between its outermost accepted
  // ones touch accepted pixels of the row before.
  bool continuity = true;
  // A row that is wider than the row before by more than `width_jump_px` ends the finger.
  bool shape = true;
  // How far above the border the finger's edges and colour are read. Bezels of the samples are 15 to 20 px high in the
  // picture, and the longest line may be the bezel's mirror image 9 px below the border: 14 stays on the bezel in both.
  int border_offset_px = 14;
  // Grey levels between neighbouring groups of columns. Shading, noise and reflections on an untouched bezel stay
  // below.
  double least_edge_step = 12;
  // Well above what noise and shading change from row to row. From 4 to 20, touches of both samples are found about
  // alike; below 11 the calibration touches of the second do not solve.
  int width_jump_px = 12;
};

class ThesisDetector {
 public:
  // Throws std::invalid_argument if no finger could cross the border in pictures of this size.
  ThesisDetector(const BorderLine& border, ImageSize image, const ThesisOptions& options = {});

  // At most one finger. `bgr` must be CV_8UC3 of the size given; other pictures hold no finger and are counted. The
  // result lives until the next call. Allocates nothing.
  const Fingers& detect(const cv::Mat& bgr);

  [[nodiscard]] std::uint64_t unfit_pictures() const noexcept { return unfit_pictures_; }

 private:
  struct Row {
    int first = 0;  // outermost accepted columns, both accepted; first > last: none
    int last = -1;
    [[nodiscard]] int width() const noexcept { return last - first + 1; }
  };

  void read_red_along_border(const cv::Mat& bgr);
  [[nodiscard]] FingerColour mean_colour(const FingerColumns& columns) const;
  Row accept_row(int row, const FingerColumns& columns, const FingerColour& colour);
  [[nodiscard]] bool belongs(const Row& row, const Row& before, int rows_so_far) const;
  void follow(const FingerColumns& columns, int last_row);

  BorderLine border_;
  ImageSize image_;
  ThesisOptions options_;
  int edge_row_;  // the row, relative to the border, on which edges and colour are read
  AlignedPatch strip_;
  AlignedPatch patch_;
  FingerEdgeFinder edge_finder_;
  std::vector<float> red_;                     // of each column at the edge row
  std::vector<std::uint8_t> accepted_;         // of each column: 1 if it is finger in this row
  std::vector<std::uint8_t> accepted_before_;  // in the row before
  Fingers fingers_;
  std::uint64_t unfit_pictures_ = 0;
};

}  // namespace telehug
