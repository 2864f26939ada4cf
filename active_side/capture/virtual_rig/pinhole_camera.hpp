// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/matx.hpp>

#include "common/units.hpp"

namespace telehug {

// A point of the rig frame, in mm: x and y as on the screen (right and down, as its user sees it), z out of the screen
// towards the user. The screen's surface is z = 0.
using RigPoint = cv::Vec3d;

// Where the camera is and how it is turned. Without angles it looks straight down along the screen (its optical axis is
// +y, the top of its picture points to the user).
struct CameraPose {
  RigPoint position_mm;
  double pitch_deg = 0;  // > 0: turned towards the user
  double yaw_deg = 0;    // > 0: turned towards the user's left
  double roll_deg = 0;   // > 0: the picture turns clockwise

  bool operator==(const CameraPose&) const = default;
};

// Projects points in single precision.
struct PinholeProjection {
  struct Seen {
    float u_px = 0;
    float v_px = 0;
    float depth_mm = 0;
  };

  cv::Vec3f position_mm;
  cv::Matx33f camera_of_rig;
  float focal_px = 0;
  float k1 = 0;
  float largest_r2 = 0;
  float u0_px = 0;
  float v0_px = 0;

  // Its place in the picture only where the depth is more than 1 mm.
  [[nodiscard]] Seen operator()(const cv::Vec3f& point) const {
    const float dx = point[0] - position_mm[0];
    const float dy = point[1] - position_mm[1];
    const float dz = point[2] - position_mm[2];
    const auto row = [&](int i) {
      return camera_of_rig(i, 0) * dx + camera_of_rig(i, 1) * dy + camera_of_rig(i, 2) * dz;
    };
    const float depth = row(2);
    const float near = depth > 1 ? 1 / depth : 1;
    const float x = row(0) * near;
    const float y = row(1) * near;
    const float r2 = x * x + y * y;
    const float scale = focal_px * (1 + k1 * (r2 < largest_r2 ? r2 : largest_r2));
    return {u0_px + x * scale, v0_px + y * scale, depth};
  }
};

// A pinhole camera whose lens distorts radially: a point that a perfect lens would show at x_u from the picture's
// centre, measured in focal lengths, is at x_d = x_u (1 + k1 |x_u|^2); k1 < 0 is a barrel. Without angles and
// distortion a point of the screen is at
//   u = u0 - f (x - x0) / (y - y0),   v = v0 + f z0 / (y - y0)
// with (x0, y0, z0) the camera's place: the picture is the user's view mirrored left to right.
class PinholeCamera {
 public:
  PinholeCamera(const CameraPose& pose, double focal_px, ImageSize size, double distortion_k1 = 0);

  // Only for points in front of the camera: depth_mm() > 0.
  [[nodiscard]] ImagePoint project(const RigPoint& point) const;

  // The same for drawing: quicker, and exact to a thousandth of a pixel within the picture.
  [[nodiscard]] PinholeProjection projection() const;

  // Distance of a point from the camera along its optical axis.
  [[nodiscard]] double depth_mm(const RigPoint& point) const { return in_camera(point)[2]; }

  // Direction, not normalised, in which a pixel looks; its part along the optical axis is 1.
  [[nodiscard]] RigPoint ray(double u_px, double v_px) const;

  [[nodiscard]] const RigPoint& position_mm() const noexcept { return position_mm_; }
  [[nodiscard]] double focal_px() const noexcept { return focal_px_; }
  [[nodiscard]] ImageSize size() const noexcept { return size_; }

 private:
  [[nodiscard]] cv::Vec3d in_camera(const RigPoint& point) const { return camera_of_rig_ * (point - position_mm_); }

  RigPoint position_mm_;
  cv::Matx33d camera_of_rig_;  // camera frame: u right, v down, w along the optical axis
  double focal_px_;
  ImageSize size_;
  double k1_;
  double largest_r2_;  // beyond this |x_u|^2, well outside the picture, the lens is taken to distort no further
  double u0_px_;
  double v0_px_;
};

}  // namespace telehug
