// SPDX-License-Identifier: Apache-2.0
#include "calibration/camera_watch.hpp"

#include <stdexcept>
#include <variant>

namespace telehug {
namespace {

// Three looks a second at 30 pictures a second; one takes about 0.2 ms.
constexpr int frames_per_look = 10;

}  // namespace

CameraWatch::CameraWatch(const Calibration& calibration) : model_(calibration.model()) {
  const auto* rig = std::get_if<RigModel>(&model_);
  if (rig == nullptr) return;
  try {
    eyes_ = Eyes{BorderMeasurer(rig->camera, calibration.screen), DriftWatch(rig->camera, calibration.screen)};
  } catch (const std::invalid_argument&) {
    eyes_.reset();  // no bezel in the picture: nothing to watch
  }
}

void CameraWatch::look(const cv::Mat& bgr, bool finger_seen, Timestamp time) {
  if (!eyes_) return;
  if (!eyes_->learnt) {
    if (!finger_seen) eyes_->learnt = eyes_->measurer.learn(bgr);
    return;
  }
  if (++frames_ % frames_per_look != 0) return;
  state_ = eyes_->watch.update(eyes_->measurer.measure(bgr), time).state;
  std::get<RigModel>(model_).camera = eyes_->watch.corrected_camera();
}

}  // namespace telehug
