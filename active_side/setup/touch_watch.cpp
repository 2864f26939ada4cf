// SPDX-License-Identifier: Apache-2.0
#include "setup/touch_watch.hpp"

#include <cmath>
#include <limits>
#include <variant>

#include "detection/make_detector.hpp"

namespace telehug {
namespace {

// Of the strip before the screen's edge. A guess between a finger with its hand and noise: in noisy pictures less is
// unchanged with nobody there, so nothing is taken because of it.
constexpr double unchanged_with_nobody = 0.96;

AnyDetector default_detector(const Calibration& calibration, const cv::Mat& empty) {
  const BorderStrip::Layout layout = strip_layout(calibration);
  BorderStrip strip(layout);
  strip.sample(empty, layout);
  return make_detector("default", calibration, strip);
}

}  // namespace

TouchWatch::TouchWatch(const Calibration& calibration, const cv::Mat& empty)
    : detector_(default_detector(calibration, empty)),
      camera_(std::get<RigCalibration>(calibration.solved).solution.model.camera) {}

TouchWatch::TouchWatch(const BorderLine& border, const RigCamera& rough)
    : detector_(ThesisDetector(border, rough.image())), camera_(rough) {}

TouchView TouchWatch::look(const cv::Mat& bgr, const ScreenPoint& dot) {
  TouchView view;
  finger_.reset();
  double nearest_mm = std::numeric_limits<double>::infinity();
  for (const Finger& finger : detect(detector_, bgr)) {
    const auto at = camera_.screen_point(finger.contact.value_or(finger.tip));
    if (!at) continue;
    const double apart_mm = std::hypot(at->x_mm - dot.x_mm, at->y_mm - dot.y_mm);
    if (apart_mm >= nearest_mm) continue;
    nearest_mm = apart_mm;
    finger_ = finger;
    view.finger = at;
    view.finger_px = finger.contact.value_or(finger.tip);
    view.hovers = finger.mirror.state == MirrorState::hovering;
  }
  const auto* const chosen = std::get_if<FingerDetector>(&detector_);
  view.hand_there = view.finger || (chosen != nullptr && chosen->unchanged_share() < unchanged_with_nobody);
  return view;
}

}  // namespace telehug
