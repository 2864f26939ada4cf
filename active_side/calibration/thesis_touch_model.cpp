// SPDX-License-Identifier: Apache-2.0
#include "calibration/thesis_touch_model.hpp"

#include <fmt/core.h>

#include <cmath>

namespace telehug {
namespace {

// Two heights or columns nearer than this can't be told from one another by a finger.
constexpr double least_distance_mm = 1.0;
constexpr double least_distance_px = 1.0;

std::string name_of(int number, const MeasuredTouch& touch) {
  return fmt::format("calibration touch {} at ({:.1f}, {:.1f}) mm", number, touch.screen.x_mm, touch.screen.y_mm);
}

Status check(const ScreenSize& screen, int number, const MeasuredTouch& touch) {
  const auto wrong = [&](const std::string& why) { return Error{name_of(number, touch) + " " + why}; };
  if (!std::isfinite(touch.screen.x_mm) || !std::isfinite(touch.screen.y_mm)) {
    return wrong("is not a point: touch it again");
  }
  if (touch.screen.x_mm < 0 || touch.screen.x_mm > screen.width_mm || touch.screen.y_mm < 0 ||
      touch.screen.y_mm >= screen.height_mm) {
    return wrong(fmt::format("is not on the screen of {:.1f} x {:.1f} mm, above its bottom edge: choose another point",
                             screen.width_mm, screen.height_mm));
  }
  if (!std::isfinite(touch.length_px) || touch.length_px <= 0) {
    return wrong(
        fmt::format("has a finger of {} px past the screen's bottom border, which must be more than 0: "
                    "touch it again",
                    touch.length_px));
  }
  if (!std::isfinite(touch.column_px)) return wrong("has no image column: touch it again");
  return Done{};
}

}  // namespace

Result<ThesisTouchModel> ThesisTouchModel::solve(const ScreenSize& screen, const MeasuredTouch& first,
                                                 const MeasuredTouch& second) {
  if (!std::isfinite(screen.width_mm) || !std::isfinite(screen.height_mm) || screen.width_mm <= 0 ||
      screen.height_mm <= 0) {
    return Error{fmt::format("the screen's size of {} x {} mm is impossible: measure the visible area", screen.width_mm,
                             screen.height_mm)};
  }
  if (auto good = check(screen, 1, first); !good) return good.error();
  if (auto good = check(screen, 2, second); !good) return good.error();

  const double m_h = screen.height_mm;
  const double h1 = first.screen.y_mm;
  const double h2 = second.screen.y_mm;
  const double l1 = first.length_px;
  const double l2 = second.length_px;
  const double dx = second.screen.x_mm - first.screen.x_mm;  // the thesis' 30 mm
  if (std::abs(h1 - h2) < least_distance_mm) {
    return Error{name_of(2, second) + " is as high as the first: the two must lie at different heights"};
  }
  if (std::abs(dx) < least_distance_mm) {
    return Error{name_of(2, second) + " is straight below or above the first: one must lie to the side of the other"};
  }

  // A camera above both points shows the upper one's finger longer than in proportion to its distance from the bottom
  // edge: l_upper / l_lower = (m_h - h_upper) / (m_h - h_lower) * (h_lower - d) / (h_upper - d), and the last factor
  // runs from 1 (d = -infinity) to infinity (d = h_upper). Nothing else can go wrong with d.
  const bool first_is_upper = h1 < h2;
  const MeasuredTouch& upper = first_is_upper ? first : second;
  const MeasuredTouch& lower = first_is_upper ? second : first;
  const double proportional_px = lower.length_px * (m_h - upper.screen.y_mm) / (m_h - lower.screen.y_mm);
  if (upper.length_px <= proportional_px) {
    return Error{
        fmt::format("{} has a finger of {:.1f} px, but with {:.1f} px at the lower point ({:.1f}, {:.1f}) mm "
                    "it must be longer than {:.1f} px for any camera above it: touch both again",
                    name_of(first_is_upper ? 1 : 2, upper), upper.length_px, lower.length_px, lower.screen.x_mm,
                    lower.screen.y_mm, proportional_px)};
  }

  ThesisTouchModel model;
  model.m_h_ = m_h;
  model.x1_ = first.screen.x_mm;
  model.h1_ = h1;
  model.l1_ = l1;
  model.u_s_ = first.column_px;
  model.d_ = (m_h * h2 * l2 - h1 * h2 * l2 - m_h * h1 * l1 + h1 * h2 * l1) / (h2 * l1 + m_h * l2 - m_h * l1 - h1 * l2);
  const double u_r2 = model.u_s_ * (h1 - model.d_) / (h2 - model.d_);
  model.ea1_ = (second.column_px - u_r2) * (h2 - model.d_) / dx;
  if (!std::isfinite(model.d_) || !std::isfinite(model.ea1_) || std::abs(second.column_px - u_r2) < least_distance_px) {
    return Error{
        fmt::format("{} is seen in the column {:.1f} px, straight in line with the first one's {:.1f} px, "
                    "although it is {:.1f} mm beside it: touch both again",
                    name_of(2, second), second.column_px, first.column_px, dx)};
  }
  return model;
}

}  // namespace telehug
