// SPDX-License-Identifier: Apache-2.0
#include "capture/virtual_rig/mirror_contrast.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

namespace telehug {
namespace {

// Of the finger's width: the part of the mirror image from its foremost point that is looked at.
constexpr double part_of_width = 0.7;
constexpr double part_of_length = 0.5;
constexpr int least_px = 9;

cv::Rect mirrored_tip(const PinholeCamera& camera, const HandPose& hand) {
  const FingerPlace& finger = hand.finger;
  const RigPoint mirrored(finger.foot.x_mm, finger.foot.y_mm, -finger.hover_mm);
  if (camera.depth_mm(mirrored) <= 0) return {};
  const ImagePoint tip = camera.project(mirrored);
  const ImagePoint beside = camera.project(mirrored + RigPoint(1, 0, 0));
  const double width_px =
      hand.looks.value_or(HandLooks{}).finger_width_mm * std::hypot(beside.u_px - tip.u_px, beside.v_px - tip.v_px);
  const auto px = [](double value) { return static_cast<int>(std::lround(value)); };
  return {px(tip.u_px - part_of_width * width_px / 2), px(tip.v_px), px(part_of_width * width_px),
          px(part_of_length * width_px)};
}

}  // namespace

double mirror_contrast(RigRenderer& renderer, const std::vector<HandPose>& hands) {
  if (hands.empty()) return 0;
  cv::Mat with;
  cv::Mat without;
  renderer.draw(hands, 0, with);
  const cv::Rect tip = mirrored_tip(renderer.camera(), hands.front()) & cv::Rect({0, 0}, with.size());
  if (tip.area() < least_px) return 0;
  renderer.leave_out_mirror_images(true);
  renderer.draw(hands, 0, without);
  renderer.leave_out_mirror_images(false);
  const cv::Scalar difference = cv::mean(with(tip)) - cv::mean(without(tip));
  return std::max({std::abs(difference[0]), std::abs(difference[1]), std::abs(difference[2])});
}

}  // namespace telehug
