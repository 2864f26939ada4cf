// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>

#include "calibration/calibration.hpp"
#include "common/units.hpp"
#include "finger/any_detector.hpp"

namespace telehug {

// The finger that should touch a dot, in one picture.
struct TouchView {
  std::optional<ScreenPoint> finger;  // read as a touch: one that hovers at h seems to lie lower by some 5 h and more
  std::optional<ImagePoint> finger_px;
  bool hovers = false;      // surely so
  bool hand_there = false;  // something reaches across the screen's edge, be it a finger or not
};

// Looks for it with the rig's detector. Pictures are CV_8UC3 of one size with the screen below its edge.
class TouchWatch {
 public:
  // The default detector, with the camera of `calibration` (as_calibration()) and the picture with nobody there.
  // Throws std::invalid_argument if no finger could be seen with this camera.
  TouchWatch(const Calibration& calibration, const cv::Mat& empty);
  // The thesis' detector, whose fingers are placed on the screen by a camera that is not known well.
  TouchWatch(const BorderLine& border, const RigCamera& rough);

  // Of several fingers the one nearest to `dot`.
  [[nodiscard]] TouchView look(const cv::Mat& bgr, const ScreenPoint& dot);
  // The same finger as the detector says it.
  [[nodiscard]] const std::optional<Finger>& finger() const noexcept { return finger_; }

 private:
  AnyDetector detector_;
  RigCamera camera_;
  std::optional<Finger> finger_;
};

}  // namespace telehug
