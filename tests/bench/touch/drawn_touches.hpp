// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>

#include "bench/touch/touch_path.hpp"
#include "calibration/border_curve.hpp"
#include "calibration/rig_camera.hpp"
#include "finger/border_strip.hpp"
#include "finger/finger_detector.hpp"

namespace telehug {

// A virtual rig and pictures of it in all of which the detector sees so many fingers (1 or 5).
struct DrawnTouches {
  DrawnTouches(ImageSize image, int fingers);
  DrawnTouches(const DrawnTouches&) = delete;
  DrawnTouches& operator=(const DrawnTouches&) = delete;

  cv::Mat empty;  // nobody there
  RigCamera camera;
  BorderCurve border;
  FingerDetector detector;
  TouchedRig touched;

 private:
  struct Scene;
  DrawnTouches(Scene&& scene, ImageSize image, int fingers);
};

}  // namespace telehug
