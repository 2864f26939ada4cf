// SPDX-License-Identifier: Apache-2.0
#include "setup/dot_plan.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "calibration/calibration_page.hpp"

namespace telehug {
namespace {

// In parts of the screen. The camera's turn and lens show at the sides, its distance between above and below.
constexpr std::array<PartOfScreen, full_calibration_dots> wanted{{{0.22, 0.78},
                                                                  {0.78, 0.78},
                                                                  {0.5, 0.62},
                                                                  {0.34, 0.93},
                                                                  {0.66, 0.93},
                                                                  {0.36, 0.58},
                                                                  {0.64, 0.58},
                                                                  {0.5, 0.8},
                                                                  {0.12, 0.9}}};
constexpr PartOfScreen well_seen{0.5, 0.88};

}  // namespace

bool sees_dot(const RigCamera& camera, const ScreenPoint& dot, double margin_px) {
  constexpr int sides = 8;
  const ImageSize image = camera.image();
  for (int i = 0; i < sides; ++i) {
    const double turn = 2 * std::numbers::pi * i / sides;
    const auto at = camera.project(ScreenPoint{dot.x_mm + calibration_dot_mm / 2 * std::cos(turn),
                                               dot.y_mm + calibration_dot_mm / 2 * std::sin(turn)});
    if (!at || at->u_px < margin_px || at->v_px < margin_px || at->u_px > image.width_px - 1 - margin_px ||
        at->v_px > image.height_px - 1 - margin_px) {
      return false;
    }
  }
  return true;
}

std::vector<ScreenPoint> plan_dots(const RigCamera& camera, const ScreenSize& screen, std::size_t count,
                                   double margin_px) {
  constexpr int steps = 40;
  std::vector<ScreenPoint> dots;
  for (const PartOfScreen& part : wanted) {
    if (dots.size() == count) break;
    for (int step = 0; step <= steps; ++step) {
      const double moved = static_cast<double>(step) / steps;
      const ScreenPoint dot{(part.x + moved * (well_seen.x - part.x)) * screen.width_mm,
                            (part.y + moved * (well_seen.y - part.y)) * screen.height_mm};
      if (!sees_dot(camera, dot, margin_px)) continue;
      const bool free = std::none_of(dots.begin(), dots.end(), [&](const ScreenPoint& other) {
        return std::hypot(dot.x_mm - other.x_mm, dot.y_mm - other.y_mm) < least_between_dots_mm;
      });
      if (free) dots.push_back(dot);
      break;
    }
  }
  return dots;
}

}  // namespace telehug
