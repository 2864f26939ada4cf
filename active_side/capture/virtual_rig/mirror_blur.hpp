// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

namespace telehug {

// Blurs mirror images as a rough surface does. A surface tilted by a small angle turns the mirrored ray by twice that
// angle; an object that the camera sees mirrored h in front of the surface, itself z0 in front of it, is thereby seen
//   2 f angle h / (z0 + h)
// pixels further up or down, by similar triangles. Sideways the effect is weaker by the sine of the grazing angle.
class MirrorBlur {
 public:
  MirrorBlur(double roughness_deg, double focal_px, double camera_z_mm);

  // `image`: CV_32FC4, premultiplied blue, green, red and coverage. `height_mm`: CV_32FC1, h where the coverage is
  // positive. In place; what lies beyond the picture is taken to be as its border.
  void apply(cv::Mat& image, const cv::Mat& height_mm);

  // How far around a mirror image its blur is worth drawing.
  [[nodiscard]] int reach_px() const;

 private:
  void blur_column(cv::Mat& image, const cv::Mat& height_mm, int column);

  double px_per_share_;  // 2 f angle
  double camera_z_mm_;
  std::vector<cv::Vec4f> sums_;
  std::vector<float> reach_px_;
};

}  // namespace telehug
