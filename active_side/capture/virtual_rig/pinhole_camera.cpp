// SPDX-License-Identifier: Apache-2.0
#include "capture/virtual_rig/pinhole_camera.hpp"

#include <cmath>
#include <numbers>

namespace telehug {
namespace {

cv::Matx33d rotation(int axis, double angle_deg) {
  const double angle = angle_deg * std::numbers::pi / 180;
  const int a = (axis + 1) % 3;
  const int b = (axis + 2) % 3;
  cv::Matx33d turned = cv::Matx33d::eye();
  turned(a, a) = turned(b, b) = std::cos(angle);
  turned(a, b) = -std::sin(angle);
  turned(b, a) = std::sin(angle);
  return turned;
}

// u = -x, v = -z, w = +y. The rig frame is left-handed (x right, y down, z to the viewer), the camera frame is not.
const cv::Matx33d straight_down{-1, 0, 0, 0, 0, -1, 0, 1, 0};

}  // namespace

PinholeCamera::PinholeCamera(const CameraPose& pose, double focal_px, ImageSize size)
    : position_mm_(pose.position_mm),
      camera_of_rig_(rotation(2, pose.roll_deg) * rotation(0, -pose.pitch_deg) * rotation(1, -pose.yaw_deg) *
                     straight_down),
      focal_px_(focal_px),
      size_(size),
      u0_px_((size.width_px - 1) / 2.0),
      v0_px_((size.height_px - 1) / 2.0) {}

ImagePoint PinholeCamera::project(const RigPoint& point) const {
  const cv::Vec3d c = in_camera(point);
  return {u0_px_ + focal_px_ * c[0] / c[2], v0_px_ + focal_px_ * c[1] / c[2]};
}

RigPoint PinholeCamera::ray(double u_px, double v_px) const {
  return camera_of_rig_.t() * cv::Vec3d{(u_px - u0_px_) / focal_px_, (v_px - v0_px_) / focal_px_, 1.0};
}

}  // namespace telehug
