// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "capture/virtual_rig/linear_light.hpp"

namespace telehug {

// A Gaussian blur of pictures that come row by row, so that a row is still in the cache when it is used. What lies
// beyond the picture is taken to be as its border.
class RowBlur {
 public:
  RowBlur(double sd_px, int reach_px);

  void begin(int columns, int rows);
  // Where the next row is to be written, and that this was done.
  [[nodiscard]] Light* next();
  void push();
  // Calls step(row, values, count) for each row that push() completed, of all their blue, green and red values.
  template <typename Step>
  void completed(Step&& step) {
    const int ready = pushed_ == rows_ ? rows_ : pushed_ - reach_px_;
    for (; done_ < ready; ++done_) {
      mix(done_);
      step(done_, mixed_.data(), mixed_.size());
    }
  }

 private:
  void mix(int row);
  [[nodiscard]] const float* blurred_row(int row) const;

  int reach_px_;
  std::vector<float> weights_;  // of the middle and of what is 1, 2... pixels away
  int rows_ = 0;
  int pushed_ = 0;
  int done_ = 0;
  std::vector<float> row_;    // with reach_px_ pixels before and behind it
  std::vector<float> ring_;   // the last 2 reach_px_ + 1 rows, blurred along themselves
  std::vector<float> mixed_;  // a row of the result
};

// Light as 16 * 255 times its root, which has room for what is too bright for pictures of 8 bits; and back.
void root_coded(const float* light, int count, std::uint16_t* coded);
void light_of(const std::uint16_t* coded, int count, float* light);

// From light to coded pictures (see Development): lens blur, tone curve, and the sharpening that webcams do.
class Lens {
 public:
  // Pixels around a change of the light that change in the coded picture.
  static constexpr int margin_px = 8;

  Lens(double blur_px, double sharpening);

  // Calls light(v, row) for each row of `around`, which writes the light of all its columns, and sets `box` of the
  // coded picture (CV_16UC3). What lies beyond `around` is taken to be as its border.
  template <typename LightRow>
  void code(const cv::Rect& around, const cv::Rect& box, cv::Mat& coded, LightRow&& light) {
    blur_.begin(around.width, around.height);
    glow_.begin(around.width, around.height);
    for (int v = around.y; v < around.y + around.height; ++v) {
      light(v, blur_.next());
      blur_.push();
      blur_.completed([&](int row, const float* values, std::size_t count) {
        take_roots(row, values, count);
        store(around, box, coded);
      });
    }
  }

 private:
  void take_roots(int row, const float* light, std::size_t count);
  void store(const cv::Rect& around, const cv::Rect& box, cv::Mat& coded);
  void store_row(int row, const float* glow, std::size_t count, const cv::Rect& around, const cv::Rect& box,
                 cv::Mat& coded);

  float sharpening_;
  RowBlur blur_;
  RowBlur glow_;              // of tones, for sharpening
  std::vector<float> tones_;  // of the last tone_rows rows
};

}  // namespace telehug
