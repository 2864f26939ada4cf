// SPDX-License-Identifier: Apache-2.0
//
// The webcam of a rig: a pinhole with one term of radial lens distortion, its principal point in the picture's centre.
//
// Rig frame, mm: x and y as on the screen (right and down as its user sees it), z out of the screen towards the user;
// the screen's surface is z = 0. Without angles the optical axis is +y and the picture's top points to the user, so
// that without distortion
//   u = u0 - f (x - x0) / (y - y0)        v = v0 + f (z0 - z) / (y - y0)
// (image right is the user's left). Angles turn the camera about its own axes: yaw, then pitch, then roll.
// Distortion: normalised coordinates (px from the centre / f) are multiplied by 1 + k1 r^2, r being their undistorted
// length.
#pragma once

#include <array>
#include <optional>

#include "common/units.hpp"

namespace telehug {

// Place or direction in the rig frame.
struct RigVector {
  double x_mm = 0;
  double y_mm = 0;
  double z_mm = 0;
};

// How the webcam delivers the picture, compared with what its lens sees. Upside down (a camera mounted the other way
// up) is both at once.
struct PictureOrientation {
  bool left_right_exchanged = false;
  bool top_bottom_exchanged = false;

  // "upright", "mirrored", "upside down" or "mirrored and upside down".
  [[nodiscard]] const char* name() const noexcept;
  friend bool operator==(const PictureOrientation&, const PictureOrientation&) = default;
};

struct RigCameraParameters {
  double focal_px = 0;  // > 0
  double k1 = 0;
  RigVector position_mm;  // z_mm > 0: in front of the screen
  double pitch_deg = 0;   // > 0: turned towards the user
  double yaw_deg = 0;     // > 0: turned towards the user's left
  double roll_deg = 0;    // > 0: the picture turns clockwise
};

// A value; nothing in it allocates.
class RigCamera {
 public:
  RigCamera(const RigCameraParameters& parameters, ImageSize image, PictureOrientation orientation = {});

  // Nothing for points that are not in front of the camera, or so far off its axis that the distortion folds over.
  // The image point may lie outside the picture.
  [[nodiscard]] std::optional<ImagePoint> project(const RigVector& point) const noexcept;
  [[nodiscard]] std::optional<ImagePoint> project(const ScreenPoint& point) const noexcept;

  // The direction, from the camera, in which a pixel looks; not normalised. Nothing where the distortion folds over.
  [[nodiscard]] std::optional<RigVector> ray(const ImagePoint& point) const noexcept;

  // Where the pixel's ray meets the plane z = z_mm, which must lie behind the camera (z_mm < z0). Nothing if it does
  // not meet it in front of the camera.
  [[nodiscard]] std::optional<ScreenPoint> screen_point(const ImagePoint& point, double z_mm = 0) const noexcept;

  // The point projects into the picture (its outermost pixels' centres included).
  [[nodiscard]] bool sees(const ScreenPoint& point) const noexcept;

  [[nodiscard]] const RigCameraParameters& parameters() const noexcept { return parameters_; }
  [[nodiscard]] const RigVector& position_mm() const noexcept { return parameters_.position_mm; }
  [[nodiscard]] ImageSize image() const noexcept { return image_; }
  [[nodiscard]] PictureOrientation orientation() const noexcept { return orientation_; }

 private:
  RigCameraParameters parameters_;
  ImageSize image_;
  PictureOrientation orientation_;
  std::array<double, 9> camera_of_rig_;  // rotation, row by row; camera frame: u right, v down, w along the axis
};

}  // namespace telehug
