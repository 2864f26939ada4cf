// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>

#include "calibration/calibration.hpp"
#include "calibration/drift_watch.hpp"

namespace telehug {

// A calibration's touch model while the camera is in use: corrected when the camera has turned a little, no longer
// trusted when it was moved. It learns how the bezel looks from the first picture without a finger, so it does not see
// what happened between the calibration and then. With the thesis' model, or where no bezel can be seen, it watches
// nothing and trusts the camera.
class CameraWatch {
 public:
  explicit CameraWatch(const Calibration& calibration);

  // For every picture; looks at some of them. `time` never decreases. Allocates nothing once it has learnt.
  void look(const cv::Mat& bgr, bool finger_seen, Timestamp time);

  [[nodiscard]] const TouchModel& model() const noexcept { return model_; }
  [[nodiscard]] DriftState state() const noexcept { return state_; }
  // False: touches mean nothing until the next calibration.
  [[nodiscard]] bool trusts_camera() const noexcept { return state_ != DriftState::moved; }

 private:
  struct Eyes {
    BorderMeasurer measurer;
    DriftWatch watch;
    bool learnt = false;
  };

  TouchModel model_;
  DriftState state_ = DriftState::steady;
  std::optional<Eyes> eyes_;
  int frames_ = 0;
};

}  // namespace telehug
