// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>

#include "face/face_finder.hpp"

namespace telehug {

// "Finds" what a test has laid down, and counts how often it was asked.
class PlannedFaceFinder final : public FaceFinder {
 public:
  explicit PlannedFaceFinder(FoundFaces planned = {}) : faces(std::move(planned)) {}

  Result<FoundFaces> find(const cv::Mat& bgr) override {
    ++searches;
    last_size = bgr.size();
    return faces;
  }
  [[nodiscard]] std::string name() const override { return "planned"; }

  Result<FoundFaces> faces;
  int searches = 0;
  cv::Size last_size;
};

}  // namespace telehug
