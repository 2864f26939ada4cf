// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <variant>

#include "finger/finger_detector.hpp"
#include "finger/thesis_detector.hpp"

namespace telehug {

// The detector that `--detector` chose: default or thesis.
using AnyDetector = std::variant<FingerDetector, ThesisDetector>;

inline const Fingers& detect(AnyDetector& detector, const cv::Mat& bgr) {
  return std::visit([&](auto& chosen) -> const Fingers& { return chosen.detect(bgr); }, detector);
}

inline std::uint64_t unfit_pictures(const AnyDetector& detector) {
  return std::visit([](const auto& chosen) { return chosen.unfit_pictures(); }, detector);
}

}  // namespace telehug
