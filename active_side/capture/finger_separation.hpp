// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>

#include "capture/border_place.hpp"
#include "common/result.hpp"

namespace telehug {

// How well a finger that rests across the screen's bottom border can be told from the border: Fisher's criterion
// d' S^-1 d, where d is the difference between the mean colours of the finger's and of the border's pixels and S the
// sum of their covariances, times the part of the pixels that is not blown out. It is the objective that the settings
// of a camera are chosen by.
class FingerSeparation {
 public:
  // From two pictures of one size and the same settings, CV_8UC3: without the finger and with it, lying across the
  // border. The error says what to do.
  static Result<FingerSeparation> find(const cv::Mat& without, const cv::Mat& with, BorderPlace border);

  // 0 (cannot be told apart) upwards; of a picture of the same size, else 0. The finger must still lie where it did.
  [[nodiscard]] double operator()(const cv::Mat& bgr) const;

  [[nodiscard]] int left_px() const noexcept { return left_px_; }
  [[nodiscard]] int right_px() const noexcept { return right_px_; }  // exclusive

 private:
  FingerSeparation(cv::Size size, BorderPlace border, int left_px, int right_px)
      : size_(size), border_(border), left_px_(left_px), right_px_(right_px) {}

  cv::Size size_;
  BorderPlace border_;
  int left_px_;
  int right_px_;
};

}  // namespace telehug
