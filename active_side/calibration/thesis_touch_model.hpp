// SPDX-License-Identifier: Apache-2.0
//
// The touch model of the thesis: where on the screen a finger's tip is, from how far the finger reaches past the image
// of the screen's bottom edge and in which column its tip lies.
//
// A camera that looks straight down from beside the screen's top sees a point y below the top at a distance
// K / (y - d) from the picture's row of the camera's foot, d being the camera's height below the top edge (negative:
// the camera is above it). Two touches of known points give d and everything else. The model knows no lens distortion,
// roll, yaw or pitch; facts on its error on real rigs: 0.6 mm vertically, 3.5 mm horizontally with perfect tips.
#pragma once

#include <array>
#include <cmath>
#include <optional>

#include "common/result.hpp"
#include "common/units.hpp"

namespace telehug {

// A touch of a known point and how the camera saw it.
struct MeasuredTouch {
  ScreenPoint screen;
  double length_px = 0;  // finger past the image of the screen's bottom edge (thesis: l1, l2), > 0
  double column_px = 0;  // of the tip, signed, from the image centre, positive to the right (thesis: u_S, u_D2)
};

// The points that the thesis has touched: the screen's middle, 100 mm below the top, and 30 mm right of the middle, 220
// mm below it, on a screen 300 mm high; on others at the same parts of the height. Any other two will do.
[[nodiscard]] constexpr std::array<ScreenPoint, 2> default_calibration_points(const ScreenSize& screen) noexcept {
  const double middle_mm = screen.width_mm / 2;
  return {ScreenPoint{middle_mm, screen.height_mm * 100 / 300},
          ScreenPoint{middle_mm + 30, screen.height_mm * 220 / 300}};
}

// Millimetres unless said otherwise; the thesis' names in brackets.
class ThesisTouchModel {
 public:
  // Says which touch is impossible and why when the two do not fit a camera that sees the whole path of the finger.
  // `first` is the thesis' reference point; `second` must lie at another height and to one side of it.
  static Result<ThesisTouchModel> solve(const ScreenSize& screen, const MeasuredTouch& first,
                                        const MeasuredTouch& second);

  // Nothing if no point of the plane below the camera looks like this. The point may lie outside the screen.
  [[nodiscard]] std::optional<ScreenPoint> screen_point(double length_px, double column_px) const noexcept;

  [[nodiscard]] double camera_below_top_mm() const noexcept { return d_; }
  // Pixels from the image centre of a point 1 mm beside the camera, 1 mm below it; negative in mirrored pictures.
  [[nodiscard]] double horizontal_scale_px() const noexcept { return ea1_; }

 private:
  ThesisTouchModel() = default;

  double m_h_ = 0;  // screen height (m_h)
  double x1_ = 0;   // horizontal place of the first reference point
  double h1_ = 0;   // its distance from the screen's top (h1)
  double l1_ = 0;   // its finger length in px (l1)
  double u_s_ = 0;  // its column (u_S)
  double d_ = 0;    // camera below the screen's top (d)
  double ea1_ = 0;  // px (EA1)
};

inline std::optional<ScreenPoint> ThesisTouchModel::screen_point(double length_px, double column_px) const noexcept {
  const double l = length_px;
  const double denominator = l * m_h_ - l * h1_ - l1_ * d_ + l1_ * h1_;
  const double f_v = (l1_ * m_h_ * (h1_ - d_) + d_ * l * (m_h_ - h1_)) / denominator;
  const double u_r = u_s_ * (h1_ - d_) / (f_v - d_);
  const double ui = (column_px - u_r) * (f_v - d_) / ea1_;
  if (!(denominator > 0) || !(f_v > d_) || !std::isfinite(f_v) || !std::isfinite(ui)) return std::nullopt;
  return ScreenPoint{x1_ + ui, f_v};
}

}  // namespace telehug
