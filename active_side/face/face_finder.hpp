// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "common/result.hpp"

namespace telehug {

struct FoundFace {
  cv::Rect2d box;  // from hairline to chin, cheek to cheek; px of the picture it was found in, may reach past its edges
  double score = 0;  // 0..1: how sure the finder is; from 0.75 on there is hardly ever no face
};

using FoundFaces = std::vector<FoundFace>;

// Finds all faces of one picture. One thread uses a finder. Every finder calibrates its own boxes to "hairline to
// chin": the grid of boxes is measured in that height.
class FaceFinder {
 public:
  virtual ~FaceFinder() = default;

  // `bgr`: CV_8UC3, CV_8UC4 (the fourth is not looked at), or empty (which has no faces). In no particular order. Never
  // throws.
  virtual Result<FoundFaces> find(const cv::Mat& bgr) = 0;

  // What status and the log call this finder: "Haar".
  [[nodiscard]] virtual std::string name() const = 0;
};

}  // namespace telehug
