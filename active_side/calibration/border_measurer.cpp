// SPDX-License-Identifier: Apache-2.0
#include "calibration/border_measurer.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "calibration/rig_residuals.hpp"

namespace telehug {
namespace {

constexpr int block_width_px = 16;
// Bezels are 15 to 20 rows high in pictures of 720 rows; a little of what is behind them belongs to the profile.
constexpr double rows_part_of_height = 1 / 26.0;
constexpr double search_part_of_height = 1 / 60.0;
constexpr int rows_left_out = 2;      // between the border and the bezel: the screen's light spreads there
constexpr double least_contrast = 2;  // grey levels, standard deviation of a profile that shows anything
constexpr double least_correlation = 0.9;
constexpr std::size_t least_columns = border_columns / 3;

double contrast(const std::vector<float>& profile) {
  const auto n = static_cast<double>(profile.size());
  const double mean = std::accumulate(profile.begin(), profile.end(), 0.0) / n;
  const double squares = std::accumulate(profile.begin(), profile.end(), 0.0,
                                         [mean](double sum, float v) { return sum + (v - mean) * (v - mean); });
  return std::sqrt(squares / n);
}

}  // namespace

BorderMeasurer::BorderMeasurer(const RigCamera& camera, const ScreenSize& screen)
    : image_(camera.image()),
      towards_user_(camera.orientation().top_bottom_exchanged ? 1 : -1),
      rows_(std::max(10, static_cast<int>(std::lround(rows_part_of_height * image_.height_px)))),
      search_px_(std::max(6, static_cast<int>(std::lround(search_part_of_height * image_.height_px)))),
      profile_(static_cast<std::size_t>(rows_ + 2 * search_px_)),
      likeness_(static_cast<std::size_t>(2 * search_px_ + 1)) {
  for (std::size_t i = 0; i < border_columns; ++i) {
    Column column;
    const double middle = (static_cast<double>(i) + 0.5) / border_columns * image_.width_px;
    column.first = static_cast<int>(middle) - block_width_px / 2;
    for (int u = column.first; u < column.first + block_width_px; ++u) {
      const auto row = border_row(camera, screen.height_mm, u);
      if (!row) break;
      const double bezel_end = *row + towards_user_ * (rows_left_out + rows_ + search_px_);
      const double screen_end = *row - towards_user_ * search_px_;
      if (std::min(bezel_end, screen_end) < 0 || std::max(bezel_end, screen_end) > image_.height_px - 2) break;
      column.row_px.push_back(*row);
    }
    if (column.row_px.size() == block_width_px) columns_.push_back(std::move(column));
  }
  if (columns_.size() < least_columns) {
    throw std::invalid_argument("the picture does not show the screen's bottom edge: calibrate again");
  }
}

bool BorderMeasurer::fits(const cv::Mat& bgr) const {
  return bgr.type() == CV_8UC3 && bgr.cols == image_.width_px && bgr.rows == image_.height_px;
}

// Along the border, so that its slope does not blur the profile.
void BorderMeasurer::read_profile(const cv::Mat& bgr, const Column& column) {
  std::fill(profile_.begin(), profile_.end(), 0.0F);
  for (std::size_t c = 0; c < column.row_px.size(); ++c) {
    const double start = column.row_px[c] + towards_user_ * (rows_left_out + rows_ + search_px_);
    const int u = column.first + static_cast<int>(c);
    const auto grey = [&](int v) {
      const auto& pixel = bgr.at<cv::Vec3b>(v, u);
      return static_cast<float>(pixel[0] + pixel[1] + pixel[2]) / 3.0F;
    };
    for (std::size_t i = 0; i < profile_.size(); ++i) {
      const double at = start - towards_user_ * static_cast<double>(i);
      const int v = static_cast<int>(std::floor(at));
      const auto part = static_cast<float>(at - v);
      profile_[i] += ((1 - part) * grey(v) + part * grey(v + 1)) / block_width_px;
    }
  }
}

bool BorderMeasurer::learn(const cv::Mat& bgr) {
  if (!fits(bgr)) return false;
  std::vector<std::vector<float>> learnt(columns_.size());
  std::size_t seen = 0;
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    read_profile(bgr, columns_[i]);
    const std::vector<float> bezel(profile_.begin() + search_px_, profile_.begin() + search_px_ + rows_);
    if (contrast(bezel) < least_contrast) continue;
    learnt[i] = bezel;
    ++seen;
  }
  if (seen < least_columns) return false;
  for (std::size_t i = 0; i < columns_.size(); ++i)
    columns_[i].learnt = std::move(learnt[i]);
  return true;
}

double BorderMeasurer::correlation(const Column& column, std::size_t first) const {
  const std::size_t n = column.learnt.size();
  double sa = 0, sb = 0, saa = 0, sbb = 0, sab = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double a = column.learnt[i];
    const double b = profile_[first + i];
    sa += a, sb += b, saa += a * a, sbb += b * b, sab += a * b;
  }
  const auto count = static_cast<double>(n);
  const double variances = (saa - sa * sa / count) * (sbb - sb * sb / count);
  return variances > 0 ? (sab - sa * sb / count) / std::sqrt(variances) : 0;
}

const BorderShifts& BorderMeasurer::measure(const cv::Mat& bgr) {
  shifts_.clear();
  if (!fits(bgr)) return shifts_;
  for (const Column& column : columns_) {
    if (column.learnt.empty()) continue;
    read_profile(bgr, column);
    for (std::size_t first = 0; first < likeness_.size(); ++first)
      likeness_[first] = correlation(column, first);
    const auto best = std::max_element(likeness_.begin(), likeness_.end());
    if (*best < least_correlation || best == likeness_.begin() || best + 1 == likeness_.end()) continue;
    const double before = *(best - 1), after = *(best + 1);
    const double bend = before - 2 * *best + after;
    const double vertex = bend < 0 ? 0.5 * (before - after) / bend : 0;
    shifts_.push_back({column.first + 0.5 * (block_width_px - 1),
                       -towards_user_ * (static_cast<double>(best - likeness_.begin()) - search_px_ + vertex)});
  }
  return shifts_;
}

}  // namespace telehug
