// SPDX-License-Identifier: Apache-2.0
//
// Measures, while the daemon runs, by how many rows the monitor's lower bezel has moved in the picture. The screen
// below its edge shows anything, so the bezel above it is compared with how it looked when the watch began: its profile
// across the border, in small blocks of columns, by normalised correlation, which neither exposure nor light changes.
// Columns that a finger or a hand covers do not correlate and are left out.
#pragma once

#include <array>
#include <boost/container/static_vector.hpp>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "calibration/rig_camera.hpp"
#include "common/units.hpp"

namespace telehug {

inline constexpr std::size_t border_columns = 24;

struct BorderShift {
  double u_px = 0;
  double shift_px = 0;  // > 0: the bezel has moved down in the picture
};
using BorderShifts = boost::container::static_vector<BorderShift, border_columns>;

class BorderMeasurer {
 public:
  // Throws std::invalid_argument if the picture does not show the screen's bottom edge.
  BorderMeasurer(const RigCamera& camera, const ScreenSize& screen);

  // Remembers how the bezel looks. `bgr` (CV_8UC3 of the camera's size) should show no hand; it may, where the bezel is
  // watched elsewhere. False, and nothing changes, if the picture is of another kind or shows too little of a bezel.
  bool learn(const cv::Mat& bgr);

  // The columns that show what was learnt, from left to right; none before learn(). The result lives until the next
  // call. Allocates nothing.
  const BorderShifts& measure(const cv::Mat& bgr);

  // Larger shifts can't be measured: the columns drop out.
  [[nodiscard]] double largest_shift_px() const noexcept { return search_px_ - 1; }

 private:
  struct Column {
    int first = 0;               // of the block's columns
    std::vector<double> row_px;  // of the border, in each column of the block
    std::vector<float> learnt;   // profile of the rows above the border; empty: nothing to see
  };

  [[nodiscard]] bool fits(const cv::Mat& bgr) const;
  void read_profile(const cv::Mat& bgr, const Column& column);
  // Of what was learnt with the profile from its row `first` on: 0 is a shift of -search_px_.
  [[nodiscard]] double correlation(const Column& column, std::size_t first) const;

  ImageSize image_;
  int towards_user_;  // rows' direction from the screen to the bezel: -1, in pictures upside down 1
  int rows_;          // of the bezel that are compared
  int search_px_;
  std::vector<Column> columns_;
  std::vector<float> profile_;    // of the column at hand: rows_ and search_px_ more on both sides
  std::vector<double> likeness_;  // correlation by shift, from -search_px_ on
  BorderShifts shifts_;
};

}  // namespace telehug
