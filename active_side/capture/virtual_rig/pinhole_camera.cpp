// SPDX-License-Identifier: Apache-2.0
#include "capture/virtual_rig/pinhole_camera.hpp"

#include <algorithm>
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

// The polynomial stops rising at r^2 = -1 / (3 k1); three quarters of that is safe, and 4 is beyond any picture.
double largest_r2(double k1) {
  return k1 < 0 ? std::min(4.0, -1 / (4 * k1)) : 4.0;
}

// u = -x, v = -z, w = +y. The rig frame is left-handed (x right, y down, z to the viewer), the camera frame is not.
const cv::Matx33d straight_down{-1, 0, 0, 0, 0, -1, 0, 1, 0};

}  // namespace

PinholeCamera::PinholeCamera(const CameraPose& pose, double focal_px, ImageSize size, double distortion_k1)
    : position_mm_(pose.position_mm),
      camera_of_rig_(rotation(2, pose.roll_deg) * rotation(0, -pose.pitch_deg) * rotation(1, -pose.yaw_deg) *
                     straight_down),
      focal_px_(focal_px),
      size_(size),
      k1_(distortion_k1),
      largest_r2_(largest_r2(distortion_k1)),
      u0_px_((size.width_px - 1) / 2.0),
      v0_px_((size.height_px - 1) / 2.0) {}

ImagePoint PinholeCamera::project(const RigPoint& point) const {
  const cv::Vec3d c = in_camera(point);
  const double x = c[0] / c[2];
  const double y = c[1] / c[2];
  const double scale = focal_px_ * (1 + k1_ * std::min(x * x + y * y, largest_r2_));
  return {u0_px_ + x * scale, v0_px_ + y * scale};
}

PinholeProjection PinholeCamera::projection() const {
  return {cv::Vec3f(position_mm_),   cv::Matx33f(camera_of_rig_),     static_cast<float>(focal_px_),
          static_cast<float>(k1_),   static_cast<float>(largest_r2_), static_cast<float>(u0_px_),
          static_cast<float>(v0_px_)};
}

// Newton's method on r_u (1 + k1 r_u^2) = r_d: six steps are exact to 1e-12 within a picture.
RigPoint PinholeCamera::ray(double u_px, double v_px) const {
  const double x = (u_px - u0_px_) / focal_px_;
  const double y = (v_px - v0_px_) / focal_px_;
  double scale = 1;
  if (k1_ != 0) {
    const double r_d = std::sqrt(x * x + y * y);
    double r_u = r_d;
    for (int i = 0; i < 6; ++i) {
      const double r2 = std::min(r_u * r_u, largest_r2_);
      const double step = (r_u * (1 + k1_ * r2) - r_d) / (1 + 3 * k1_ * r2);
      r_u -= step;
      if (std::abs(step) < 1e-7) break;  // the next step would be of 1e-14
    }
    if (r_d > 0) scale = r_u / r_d;
  }
  return camera_of_rig_.t() * cv::Vec3d{x * scale, y * scale, 1.0};
}

}  // namespace telehug
