// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "capture/virtual_rig/distance_grid.hpp"
#include "capture/virtual_rig/linear_light.hpp"
#include "capture/virtual_rig/pinhole_camera.hpp"

namespace telehug {

// Soft shadows that hands throw onto the desk and onto the bezel's edge, roughly: limbs are carried along the lamp's
// light onto the plane, drawn as thick lines at a quarter of the picture's size, and spread by a lamp's usual size.
class HandShadow {
 public:
  // `surface`: CV_8UC1, a Surface for each pixel.
  HandShadow(const VirtualRigSettings& settings, const cv::Mat& surface);

  void clear();
  void add(const std::vector<Limb>& limbs, const cv::Vec3f& origin, const PinholeCamera& camera);

  // After the last hand. Then, for each row of the picture: where it may be shaded, and what coded light, the root of
  // linear light, is multiplied with in all these columns.
  void finish();
  [[nodiscard]] cv::Range columns(int v) const;
  void factors(int v, float* factor) const;

 private:
  struct Plane {
    float y_mm = 0;
    cv::Mat takes;    // CV_32FC1, a quarter of the picture's size: share of the pixels on this plane
    cv::Mat density;  // the same size: 1 in full shadow
    cv::Rect box;
    float softness_px = 0;
  };

  cv::Size size_;
  cv::Vec3f towards_lamp_;
  float strength_ = 0;
  std::array<Plane, 2> planes_;
  cv::Rect box_;                    // of `factor_` where there may be shadow, in its pixels
  cv::Mat factor_;                  // CV_32FC1 of a quarter of the picture's size
  std::vector<cv::Range> columns_;  // of each row of factor_: where it is less than 1
  mutable std::vector<float> between_;
};

}  // namespace telehug
