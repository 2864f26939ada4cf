// SPDX-License-Identifier: Apache-2.0
#include "setup/still_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <opencv2/imgproc.hpp>

#include "pictures/median_picture.hpp"

namespace telehug {
namespace {

constexpr double largest_change = 15;  // of a field, in grey levels; exposures that differ by 13 % leave up to 14
constexpr int changed_fields = 4;      // that are more than a flicker
// Of the whole picture: more is a lamp that was switched, or another page.
constexpr double largest_gain = 2;
constexpr std::size_t most_kept = 8;
constexpr int kept_every = 2;  // pictures

cv::Mat fields_of(const cv::Mat& bgr) {
  constexpr int columns = 80;
  cv::Mat grey, small, fields;
  cv::resize(bgr, small, {columns, std::max(1, columns * bgr.rows / bgr.cols)}, 0, 0, cv::INTER_AREA);
  cv::cvtColor(small, grey, cv::COLOR_BGR2GRAY);
  grey.convertTo(fields, CV_32F);
  return fields;
}

// The fields as the camera would have shown them with the exposure of `wanted`. By what fields of about the same level
// have become on average: one gain for all is wrong where the picture is nearly white.
cv::Mat in_tones_of(const cv::Mat& wanted, const cv::Mat& fields) {
  constexpr std::size_t levels = 32;
  struct Level {
    float before = 0, now = 0;
    int count = 0;
  };
  std::array<Level, levels> tones;
  const auto level_of = [&](float field) -> Level& {
    return tones[std::min(levels - 1, static_cast<std::size_t>(std::max(0.0F, field) / 256 * levels))];
  };
  for (int row = 0; row < fields.rows; ++row) {
    for (int column = 0; column < fields.cols; ++column) {
      Level& level = level_of(fields.at<float>(row, column));
      level.before += wanted.at<float>(row, column);
      level.now += fields.at<float>(row, column);
      ++level.count;
    }
  }
  cv::Mat toned(fields.size(), CV_32F);
  for (int row = 0; row < fields.rows; ++row) {
    for (int column = 0; column < fields.cols; ++column) {
      const float field = fields.at<float>(row, column);
      const Level& level = level_of(field);
      const float gain = (level.before + 1) / (level.now + 1);
      toned.at<float>(row, column) = (level.before + gain * (field * static_cast<float>(level.count) - level.now)) /
                                     static_cast<float>(level.count);
    }
  }
  return toned;
}

// By how much the fields have become other than what both exposures make of them. A field that is partly white already
// changes by less than its tone says.
cv::Mat changes(const cv::Mat& wanted, const cv::Mat& fields) {
  const cv::Mat toned = in_tones_of(wanted, fields);
  cv::Mat below, above;
  cv::subtract(cv::min(fields, toned), wanted, below);
  cv::subtract(wanted, cv::max(fields, toned), above);
  return cv::max(below, above);
}

}  // namespace

void StillPicture::forget() {
  first_.release();
  kept_count_ = 0;
  since_ = now_;
}

bool StillPicture::moved(const cv::Mat& fields) const {
  if (fields.size() != first_.size()) return true;
  const double gain = (cv::sum(first_)[0] + 1) / (cv::sum(fields)[0] + 1);
  if (gain > largest_gain || gain < 1 / largest_gain) return true;
  // Into the lighter tones: what is white in a picture can't be made darker.
  return cv::countNonZero((gain > 1 ? changes(first_, fields) : changes(fields, first_)) > largest_change) >=
         changed_fields;
}

void StillPicture::look(const cv::Mat& bgr, Timestamp now) {
  const cv::Mat fields = fields_of(bgr);
  now_ = now;
  if (first_.empty() || moved(fields)) {
    first_ = fields;
    since_ = now;
    kept_count_ = 0;
    looked_ = 0;
  }
  if (looked_++ % kept_every != 0 || kept_count_ == most_kept) return;
  if (kept_.size() == kept_count_) kept_.emplace_back();
  bgr.copyTo(kept_[kept_count_++]);
}

cv::Mat StillPicture::picture() const {
  return median_picture({kept_.begin(), kept_.begin() + static_cast<std::ptrdiff_t>(kept_count_)});
}

}  // namespace telehug
