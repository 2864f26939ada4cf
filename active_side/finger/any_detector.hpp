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

// After detect() of a live camera's frame that can be believed, see FingerDetector::adapt().
inline void adapt(AnyDetector& detector, Timestamp now) {
  if (auto* chosen = std::get_if<FingerDetector>(&detector)) chosen->adapt(now);
}

// The default detector's background; the thesis' has none.
inline const BackgroundLearner* background(const AnyDetector& detector) {
  const auto* chosen = std::get_if<FingerDetector>(&detector);
  return chosen == nullptr ? nullptr : &chosen->background();
}

}  // namespace telehug
