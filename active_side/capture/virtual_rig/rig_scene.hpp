// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>

#include "capture/virtual_rig/linear_light.hpp"
#include "capture/virtual_rig/pinhole_camera.hpp"
#include "capture/virtual_rig/settings.hpp"

namespace telehug {

// What the camera sees while nobody is there: screen, bezel, desk and what lies on it. All of the picture's size,
// before lens and sensor. A pixel's light is own + reflectance * mirrored.
struct RigScene {
  cv::Mat own;          // CV_32FC3, linear
  cv::Mat mirrored;     // CV_32FC3, what the screen mirrors, already blurred by its roughness; 0 elsewhere
  cv::Mat reflectance;  // CV_32FC1, share of the light that the screen mirrors here; 0 elsewhere
  cv::Mat surface;      // CV_8UC1, a Surface
  cv::Mat content;      // CV_32FC3, light of the screen's picture at 1 px per 10 mm: what falls onto fingers before it

  // Light that the screen sends out around a place, mean over some 20 mm.
  [[nodiscard]] Light screen_light(float x_mm, float y_mm) const;
};

// `shown` is on the screen (CV_8UC3, any size, stretched over it).
RigScene render_scene(const VirtualRigSettings& settings, const PinholeCamera& camera, const cv::Mat& shown);

// Share of light that glass (index 1.5) mirrors when it comes at an angle whose cosine to the normal is given.
float fresnel(float cosine);

}  // namespace telehug
