// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>
#include <span>
#include <vector>

namespace telehug {

// Do these areas together cover all of `rect`?
bool is_covered(const cv::Rect& rect, std::span<const cv::Rect> areas);

// Parts of a picture, set aside while the whole is filled anew.
class KeptAreas {
 public:
  void keep(const cv::Mat& picture, std::span<const cv::Rect> areas_px);  // cut to the picture
  void put_back(cv::Mat& picture) const;                                  // of the same size and type

 private:
  struct Kept {
    cv::Rect area_px;
    cv::Mat pixels;
  };
  std::vector<Kept> kept_;
};

}  // namespace telehug
