// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "calibration/rig_camera.hpp"
#include "common/units.hpp"

namespace telehug {

// A circle on the screen as a camera sees it. The points go once round it, beginning to the right of the centre (as the
// user sees the screen) and continuing towards the screen's bottom.
struct DotOutline {
  static constexpr std::size_t count = 48;
  struct Point {
    ImagePoint image;
    double normal_u = 0;  // unit vector, outwards
    double normal_v = 0;
    double cosine = 0;  // of the direction from the circle's centre, on the screen
    double sine = 0;    // > 0: towards the screen's bottom

    // The place so far outside the outline, across it.
    [[nodiscard]] ImagePoint along(double outwards_px) const noexcept {
      return {image.u_px + outwards_px * normal_u, image.v_px + outwards_px * normal_v};
    }
  };
  std::array<Point, count> points;

  // A finger that touches the dot hides what lies behind it, as seen from the camera; this arc stays visible.
  [[nodiscard]] static bool is_visible(const Point& point) noexcept { return point.sine < 0.43; }
};

// Nothing if the camera does not see the whole circle (it may lie outside the picture).
[[nodiscard]] std::optional<DotOutline> dot_outline(const RigCamera& camera, const ImagePoint& centre,
                                                    double diameter_mm) noexcept;

}  // namespace telehug
