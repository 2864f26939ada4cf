// SPDX-License-Identifier: Apache-2.0
//
// What a calibration measures of a rig, and what is known of rigs beforehand.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "calibration/rig_camera.hpp"
#include "common/units.hpp"

namespace telehug {

// What of a touch the image point is: the finger's foremost point, the dot on the screen that the finger touches, or
// where the finger touches the screen.
enum class TouchEvidence { fingertip, dot, contact };

// As the calibration file and people call it: "fingertip", "dot", "contact".
[[nodiscard]] constexpr const char* name_of(TouchEvidence evidence) noexcept {
  switch (evidence) {
    case TouchEvidence::dot:
      return "dot";
    case TouchEvidence::contact:
      return "contact";
    case TouchEvidence::fingertip:
      break;
  }
  return "fingertip";
}

// A point of the screen and where the picture shows it. Standard deviations are of the image point, > 0.
struct PointObservation {
  ScreenPoint screen;
  ImagePoint image;
  double sigma_u_px = 1;
  double sigma_v_px = 1;
  TouchEvidence evidence = TouchEvidence::fingertip;  // of touches; marks and contacts are like dots
  bool left_out = false;                              // contradicts the others: kept to be told of, not used
};

// An image point on the image of the screen's bottom edge; where on the edge is not known.
struct BorderObservation {
  ImagePoint image;
  double sigma_px = 1;  // of its row, > 0
};

struct RigObservations {
  ScreenSize screen;
  ImageSize image;
  std::vector<PointObservation> touches;
  std::vector<PointObservation> marks;  // flat on the screen: the triangle's vertex, corners
  std::vector<BorderObservation> border;
};

// The order of the parameters wherever they are a vector.
struct RigParameter {
  enum : std::size_t { focal_px, k1, x0_mm, y0_mm, z0_mm, pitch_deg, yaw_deg, roll_deg, contact_radius_mm, count };
};
using RigParameters = std::array<double, RigParameter::count>;
using RigCovariance = std::array<RigParameters, RigParameter::count>;

// Normal distributions of the parameters.
struct RigPriors {
  RigParameters mean{};
  RigParameters sd{};
};

// Facts on webcams on top of monitors. The contact radius stands for 1.7 mm (sd 0.5) between the visible tip and the
// contact of a finger's pad, as facts have it, where the ray meets the screen at the usual angle: a camera 50 mm in
// front of the screen and a touch 225 mm below it have tan a = 0.22, tan(a / 2) = 0.11, hence 15.4 mm (sd 4.5). It is a
// number for the offset, not the finger's size: pads are flat.
[[nodiscard]] constexpr RigPriors usual_rigs(const ScreenSize& screen, ImageSize image) noexcept {
  const double scale = image.width_px / 1280.0;
  return {{950 * scale, 0, 0.5 * screen.width_mm, -10, 50, 0, 0, 0, 15.4},
          {200 * scale, 0.08, 25, 25, 25, 3.4, 3.4, 3.4, 4.5}};
}

}  // namespace telehug
