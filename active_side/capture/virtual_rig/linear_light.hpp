// SPDX-License-Identifier: Apache-2.0
//
// Light is added, mirrored and blurred in linear units (1: a white sheet in the room's light at level 1); pictures hold
// its square root, close to the tone curve of a webcam.
#pragma once

#include <algorithm>
#include <cmath>
#include <opencv2/core/matx.hpp>

#include "capture/virtual_rig/settings.hpp"

namespace telehug {

using Light = cv::Vec3f;  // blue, green, red, linear

inline Light linear(const Tint& tint) {
  Light light;
  for (int i = 0; i < 3; ++i)
    light[i] = static_cast<float>(tint[i] / 255 * (tint[i] / 255));
  return light;
}

inline Light product(const Light& a, const Light& b) {
  return {a[0] * b[0], a[1] * b[1], a[2] * b[2]};
}

// What falls onto a surface. `openness`: how much of the surroundings it sees, 0 to 1.
class RoomLighting {
 public:
  explicit RoomLighting(const RoomLight& light)
      : colour_(light.colour * light.level),
        towards_(light.towards * (1 / cv::norm(light.towards))),
        directed_(static_cast<float>(light.directed)),
        contact_shade_(static_cast<float>(light.contact_shade)),
        contact_shade_mm_(static_cast<float>(light.contact_shade_mm)) {}

  [[nodiscard]] Light on(const cv::Vec3f& normal, float openness = 1, float lamp_seen = 1) const {
    // Averaged over all directions a surface faces a lamp by a quarter; what faces it gets more than its share.
    const float facing = std::max(0.0F, normal.dot(towards_));
    return colour_ * ((1 - directed_) * openness + directed_ * lamp_seen * 2 * facing);
  }

  // What light on a hand is multiplied with this far from the screen.
  [[nodiscard]] float near_screen(float height_mm) const {
    return contact_shade_ > 0 ? 1 - contact_shade_ * std::exp(-height_mm / contact_shade_mm_) : 1.0F;
  }

  [[nodiscard]] const cv::Vec3f& towards() const noexcept { return towards_; }
  [[nodiscard]] float directed() const noexcept { return directed_; }

 private:
  Light colour_;
  cv::Vec3f towards_;
  float directed_;
  float contact_shade_;
  float contact_shade_mm_;
};

}  // namespace telehug
