// SPDX-License-Identifier: Apache-2.0
#include "capture/finger_separation.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <vector>

namespace telehug {
namespace {

// The strip lies on the bezel: desk-side of the edge, whose blur it leaves out. Bezels are 15 px and more wide.
constexpr int strip_first_px = -12;
constexpr int strip_rows = 9;
constexpr int least_finger_px = 8;
constexpr int least_difference = 20;  // grey levels, summed over the three colours
constexpr int blown_out = 253;
constexpr double noise_variance = 4;  // of 8-bit pixels at best; keeps S invertible

int strip_row(const BorderPlace& border, int column) {
  return static_cast<int>(std::lround(border.v0_px + border.slope * column)) + strip_first_px;
}

bool strip_fits(const BorderPlace& border, const cv::Size& size) {
  for (const int column : {0, size.width - 1}) {
    const int row = strip_row(border, column);
    if (row < 0 || row + strip_rows > size.height) return false;
  }
  return true;
}

cv::Vec3d column_mean(const cv::Mat& bgr, const BorderPlace& border, int column) {
  cv::Vec3d sum{};
  const int first = strip_row(border, column);
  for (int row = first; row < first + strip_rows; ++row)
    sum += cv::Vec3d(bgr.at<cv::Vec3b>(row, column));
  return sum / strip_rows;
}

// Mean and covariance of the pixels of some columns of the strip.
struct Colours {
  double count = 0;
  double blown = 0;
  cv::Vec3d sum{};
  cv::Matx33d squares{};

  void add(const cv::Mat& bgr, const BorderPlace& border, int first_column, int last_column) {
    for (int column = std::max(0, first_column); column < std::min(bgr.cols, last_column); ++column) {
      const int first = strip_row(border, column);
      for (int row = first; row < first + strip_rows; ++row) {
        const auto& pixel = bgr.at<cv::Vec3b>(row, column);
        const cv::Vec3d colour(pixel);
        sum += colour;
        squares += colour * colour.t();
        count += 1;
        blown += std::max({pixel[0], pixel[1], pixel[2]}) >= blown_out ? 1 : 0;
      }
    }
  }
  [[nodiscard]] cv::Vec3d mean() const { return sum / count; }
  [[nodiscard]] cv::Matx33d covariance() const { return squares * (1 / count) - mean() * mean().t(); }
};

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

Result<FingerSeparation> FingerSeparation::find(const cv::Mat& without, const cv::Mat& with, BorderPlace border) {
  if (without.type() != CV_8UC3 || with.type() != CV_8UC3 || without.size() != with.size() ||
      !strip_fits(border, with.size())) {
    return Error{"the screen's border does not lie in the camera's picture; calibrate, then tune"};
  }
  std::vector<cv::Vec3d> change;
  change.reserve(static_cast<std::size_t>(with.cols));
  for (int column = 0; column < with.cols; ++column)
    change.push_back(column_mean(with, border, column) - column_mean(without, border, column));
  // What changed everywhere is the camera's doing.
  cv::Vec3d everywhere;
  for (int colour = 0; colour < 3; ++colour) {
    std::vector<double> values;
    values.reserve(change.size());
    for (const cv::Vec3d& of_column : change)
      values.push_back(of_column[colour]);
    everywhere[colour] = median(std::move(values));
  }
  int left = 0;
  int widest = 0;
  int run = 0;
  for (int column = 0; column < with.cols; ++column) {
    const cv::Vec3d own = change[static_cast<std::size_t>(column)] - everywhere;
    run = cv::norm(own, cv::NORM_L1) >= least_difference ? run + 1 : 0;
    if (run <= widest) continue;
    widest = run;
    left = column - run + 1;
  }
  if (widest < least_finger_px || widest > with.cols / 3) {
    return Error{
        "no finger lies across the screen's bottom border; lay one finger on the screen, from below, and keep it "
        "there"};
  }
  return FingerSeparation(with.size(), border, left, left + widest);
}

double FingerSeparation::operator()(const cv::Mat& bgr) const {
  if (bgr.size() != size_ || bgr.type() != CV_8UC3) return 0;
  const int width = right_px_ - left_px_;
  Colours finger;
  finger.add(bgr, border_, left_px_ + width / 8, right_px_ - width / 8);  // without its soft sides
  Colours beside;
  beside.add(bgr, border_, left_px_ - 3 * width, left_px_ - width / 2);
  beside.add(bgr, border_, right_px_ + width / 2, right_px_ + 3 * width);
  if (finger.count == 0 || beside.count == 0) return 0;
  const cv::Vec3d apart = finger.mean() - beside.mean();
  const cv::Matx33d scatter = finger.covariance() + beside.covariance() + noise_variance * cv::Matx33d::eye();
  const double fisher = (apart.t() * scatter.inv() * apart)(0);
  return fisher * (1 - (finger.blown + beside.blown) / (finger.count + beside.count));
}

}  // namespace telehug
