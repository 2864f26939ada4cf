// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>

#include "common/clock.hpp"

namespace telehug {

struct Light {
  int pictures = 0;
  double mean = 0;         // of grey, 0 (black) to 1 (white)
  double dark_share = 0;   // of the picture: below 16 of 255
  double blown_share = 0;  // of the picture: above 250 of 255
  double flicker = 0;      // how far `mean` of a picture lies off its neighbours' middle, as a share of it
  double rate_hz = 0;      // 0 with fewer than two pictures
};

// Whether there is light enough to see a finger by, from some pictures of a camera; keeps none of them.
class LightMeter {
 public:
  // CV_8UC3, not empty; taken at `time`.
  void add(const cv::Mat& bgr, Timestamp time);
  [[nodiscard]] Light light() const;

 private:
  Light sums_;
  double change_ = 0;
  double newest_mean_ = 0;
  double mean_before_ = 0;
  Timestamp first_;
  Timestamp newest_;
};

}  // namespace telehug
