// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>

#include "capture/virtual_rig/linear_light.hpp"
#include "capture/virtual_rig/pinhole_camera.hpp"
#include "capture/virtual_rig/settings.hpp"

namespace telehug {

// What the camera sees while nobody is there: screen, bezel, desk and what lies on it. All of the picture's size,
// before lens and sensor. A pixel's light is own + screen's share * what the screen shows there + reflectance *
// mirrored.
struct RigScene {
  cv::Mat own;          // CV_32FC3, linear, without what the screen shows
  cv::Mat screen;       // CV_32FC3: x and y in mm on the screen, and how much of the pixel looks at it
  cv::Mat mirrored;     // CV_32FC3, what the screen mirrors, already blurred by its roughness; 0 elsewhere
  cv::Mat reflectance;  // CV_32FC1, share of the light that the screen mirrors here; 0 elsewhere
  cv::Mat surface;      // CV_8UC1, a Surface
};

RigScene render_scene(const VirtualRigSettings& settings, const PinholeCamera& camera);

// Whether both rigs' scenes are the same.
bool same_scene(const VirtualRigSettings& a, const VirtualRigSettings& b);

// Share of light that glass (index 1.5) mirrors when it comes at an angle whose cosine to the normal is given.
float fresnel(float cosine);

}  // namespace telehug
