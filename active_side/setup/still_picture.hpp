// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "common/clock.hpp"

namespace telehug {

// Whether nothing has moved before the camera for a while, and what it saw meanwhile without noise and flicker.
//
// Pictures are compared with the first one of that while in fields of 16 x 16 px (in pictures of 1280 columns), after
// bringing both to the same tones, since cameras change their exposure from frame to frame: noise of 3 grey levels a
// pixel is 0.2 in such a field, a hand changes some by 20 and more.
class StillPicture {
 public:
  // CV_8UC3; one of another size than before begins anew. `now` never decreases.
  void look(const cv::Mat& bgr, Timestamp now);
  void forget();

  // For how long nothing has moved.
  [[nodiscard]] Duration still_for() const noexcept { return now_ - since_; }
  // The median of up to eight pictures of that while; there is one after look().
  [[nodiscard]] cv::Mat picture() const;

 private:
  [[nodiscard]] bool moved(const cv::Mat& fields) const;

  cv::Mat first_;  // CV_32F fields of the first picture
  std::vector<cv::Mat> kept_;
  std::size_t kept_count_ = 0;
  int looked_ = 0;
  Timestamp since_;
  Timestamp now_;
};

}  // namespace telehug
