// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <opencv2/core/mat.hpp>
#include <utility>

#include "face/face_finder.hpp"

namespace telehug {

// What FaceFinder::find promises, around a search that expects a picture and may throw: no picture has no faces, others
// must be BGR or BGRX, and what OpenCV throws becomes an error.
template <typename Search>
Result<FoundFaces> checked_search(const cv::Mat& bgr, const std::string& finder, Search search) {
  if (bgr.empty()) return FoundFaces{};
  if (bgr.type() != CV_8UC3 && bgr.type() != CV_8UC4) {
    return Error{"The picture is not in 8-bit BGR or BGRX, so no face can be found in it."};
  }
  try {
    return search(bgr);
  } catch (const cv::Exception& exception) {
    return Error{fmt::format("{} failed on a picture of {}x{} px: {}", finder, bgr.cols, bgr.rows, exception.what())};
  }
}

}  // namespace telehug
