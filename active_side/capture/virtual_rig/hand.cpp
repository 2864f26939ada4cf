// SPDX-License-Identifier: Apache-2.0
#include "capture/virtual_rig/hand.hpp"

namespace telehug {
namespace {

RigPoint step(const RigPoint& direction, double length_mm) {
  return direction * (length_mm / cv::norm(direction));
}

}  // namespace

Hand hand_at(const FingerPlace& place) {
  // The foremost point of a ball that lies against the screen is where it touches it.
  const RigPoint tip{place.foot.x_mm, place.foot.y_mm, place.hover_mm + fingertip_radius_mm};
  const RigPoint end_joint = tip + step({0.08, 0.55, 0.85}, 22);
  const RigPoint middle_joint = end_joint + step({0.10, 0.45, 1.0}, 24);
  const RigPoint knuckle = middle_joint + step({0.12, 0.20, 1.0}, 38);
  const auto beside = [&](double right_mm, double below_mm, double back_mm) {
    return knuckle + RigPoint{right_mm, below_mm, back_mm};
  };
  const RigPoint wrist = beside(30, 32, 75);
  return {{
      {tip, end_joint, fingertip_radius_mm, 7.2},
      {end_joint, middle_joint, 7.2, 8},
      {middle_joint, knuckle, 8, 10.5},
      {knuckle, beside(15, 30, 75), 11, 18},
      {beside(28, 4, -2), wrist, 13, 20},
      {beside(55, 12, 5), beside(45, 32, 75), 11, 18},
      {wrist, beside(50, 92, 275), 24, 35},
      {beside(2, 15, 45), beside(-28, 20, 20), 13, 10},
      {beside(-28, 20, 20), beside(-32, 23, -10), 10, 8},
      {beside(22, 4, 0), beside(22, 26, -28), 9.5, 8},
      {beside(38, 8, 2), beside(37, 28, -24), 9.5, 8},
      {beside(54, 13, 5), beside(51, 30, -16), 9, 7},
  }};
}

}  // namespace telehug
