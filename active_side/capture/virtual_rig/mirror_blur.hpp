// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "capture/virtual_rig/picture_layer.hpp"

namespace telehug {

// Blurs mirror images as a rough surface does. A surface tilted by a small angle turns the mirrored ray by twice that
// angle; an object that the camera sees mirrored h in front of the surface, itself z0 in front of it, is thereby seen
//   2 f angle h / (z0 + h)
// pixels further up or down, by similar triangles. Sideways the effect is weaker by the sine of the grazing angle.
class MirrorBlur {
 public:
  MirrorBlur(double roughness_deg, double focal_px, double camera_z_mm);

  // In place; what lies beyond the layer's box is taken to be as its border.
  void apply(PictureLayer& layer);

  // How far above and below a mirror image its blur is worth drawing.
  [[nodiscard]] int reach_px() const;

 private:
  void find_half_heights(const PictureLayer& layer);
  void blur_upright(PictureLayer& layer);
  void blur_sideways(PictureLayer& layer);

  double px_per_share_;  // 2 f angle
  double camera_z_mm_;
  cv::Mat half_px_;  // CV_32FC1: half the height of each pixel's box
  cv::Mat away_px_;  // CV_32FC1: how many rows above lies the pixel that it was taken from
  std::vector<float> carried_px_;
  std::vector<float> carried_away_px_;
  cv::Mat sums_;  // CV_32FC4: of all rows, or pixels of a row, before
};

}  // namespace telehug
