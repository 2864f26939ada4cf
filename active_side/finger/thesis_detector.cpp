// SPDX-License-Identifier: Apache-2.0
#include "finger/thesis_detector.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace telehug {
namespace {

constexpr int margin_px = AlignedPatch::margin_px;
constexpr int edge_rows = 3;  // the border row and its two neighbours

// Rows before the one from which on the continuity is checked ("from the 4th row").
constexpr int rows_without_continuity = 3;

bool border_in_picture(const BorderLine& border, ImageSize image) {
  const auto inside = [&](double v) { return v >= 0 && v <= image.height_px - 1; };
  return inside(border.v_at(0)) && inside(border.v_at(image.width_px - 1));
}

}  // namespace

ThesisDetector::ThesisDetector(const BorderLine& border, ImageSize image, const ThesisOptions& options)
    : border_(border),
      image_(image),
      options_(options),
      edge_row_(-options.border_offset_px),
      strip_({image.width_px + 2 * margin_px, edge_rows + 2 * margin_px}),
      patch_({image.width_px + 2 * margin_px, image.height_px + options.border_offset_px + 2 * margin_px + edge_rows}),
      edge_finder_(image.width_px, options.least_edge_step),
      red_(static_cast<std::size_t>(image.width_px)),
      accepted_(static_cast<std::size_t>(image.width_px)),
      accepted_before_(static_cast<std::size_t>(image.width_px)) {
  if (!border_in_picture(border, image)) {
    throw std::invalid_argument("the screen's border does not cross the whole picture: calibrate again");
  }
}

const Fingers& ThesisDetector::detect(const cv::Mat& bgr) {
  fingers_.clear();
  if (bgr.type() != CV_8UC3 || bgr.cols != image_.width_px || bgr.rows != image_.height_px) {
    ++unfit_pictures_;
    return fingers_;
  }
  read_red_along_border(bgr);
  const auto columns = edge_finder_.find(red_);
  if (!columns) return fingers_;

  // Down to the picture's bottom, which the border meets first where it lies lowest.
  const double lowest = std::max(border_.v_at(columns->first), border_.v_at(columns->end - 1));
  const int last_row = image_.height_px - 1 - static_cast<int>(std::lround(lowest));
  const int first_row = edge_row_ - edge_rows / 2 - margin_px;
  patch_.cut(bgr, border_, first_row, last_row + margin_px - first_row + 1, columns->first - margin_px,
             columns->width() + 2 * margin_px);
  patch_.erode_dilate_smooth();
  follow(*columns, last_row);
  return fingers_;
}

void ThesisDetector::read_red_along_border(const cv::Mat& bgr) {
  const int first_row = edge_row_ - edge_rows / 2;
  strip_.cut(bgr, border_, first_row - margin_px, edge_rows + 2 * margin_px, -margin_px,
             image_.width_px + 2 * margin_px);
  strip_.erode_dilate_smooth();
  for (std::size_t u = 0; u < red_.size(); ++u) {
    int sum = 0;
    for (int row = first_row; row < first_row + edge_rows; ++row)
      sum += strip_.pixels(row, static_cast<int>(u))[2];
    red_[u] = static_cast<float>(sum) / edge_rows;
  }
}

FingerColour ThesisDetector::mean_colour(const FingerColumns& columns) const {
  const int first = columns.first + columns.width() / 4;
  const int end = columns.first + 3 * columns.width() / 4;
  float blue = 0, green = 0, red = 0;
  for (int row = edge_row_ - edge_rows / 2; row <= edge_row_ + edge_rows / 2; ++row) {
    for (int u = first; u < end; ++u) {
      const std::uint8_t* const pixel = patch_.pixels(row, u);
      blue += static_cast<float>(pixel[0]);
      green += static_cast<float>(pixel[1]);
      red += static_cast<float>(pixel[2]);
    }
  }
  const auto count = static_cast<float>(edge_rows * (end - first));
  return {blue / count, green / count, red / count};
}

ThesisDetector::Row ThesisDetector::accept_row(int row, const FingerColumns& columns, const FingerColour& colour) {
  accepted_.swap(accepted_before_);
  Row found;
  for (int u = columns.first; u < columns.end; ++u) {
    const bool accepted = colour.accepts(patch_.pixels(row, u));
    accepted_[static_cast<std::size_t>(u)] = accepted ? 1 : 0;
    if (!accepted) continue;
    if (found.last < 0) found.first = u;
    found.last = u;
  }
  return found;
}

bool ThesisDetector::belongs(const Row& row, const Row& before, int rows_so_far) const {
  if (row.last < 0) return false;
  if (rows_so_far > 0 && options_.shape && row.width() > before.width() + options_.width_jump_px) return false;
  if (options_.continuity && rows_so_far >= rows_without_continuity) {
    int touching = 0;
    for (int u = row.first; u <= row.last; ++u) {
      const int from = std::max(u - 1, before.first);
      const int to = std::min(u + 1, before.last);
      bool touches = false;
      for (int neighbour = from; neighbour <= to; ++neighbour)
        touches = touches || accepted_before_[static_cast<std::size_t>(neighbour)] != 0;
      touching += touches ? 1 : 0;
    }
    return 3 * touching > 2 * row.width();
  }
  return true;
}

void ThesisDetector::follow(const FingerColumns& columns, int last_row) {
  const FingerColour colour = mean_colour(columns);
  Row before;
  int rows = 0;
  for (int row = edge_row_; row <= last_row; ++row) {
    const Row here = accept_row(row, columns, colour);
    if (!belongs(here, before, rows)) break;
    before = here;
    ++rows;
  }
  const int tip_row = edge_row_ + rows - 1;  // its distance from the border is the thesis' l
  if (rows == 0 || tip_row <= 0) return;
  const double tip_u = 0.5 * (before.first + before.last);
  // Edges lie between pixels; (0, 0) is the centre of a pixel.
  fingers_.push_back(
      {{tip_u, border_.v_at(tip_u) + tip_row}, static_cast<double>(tip_row), columns.first - 0.5, columns.end - 0.5});
}

}  // namespace telehug
