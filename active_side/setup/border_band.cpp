// SPDX-License-Identifier: Apache-2.0
#include "setup/border_band.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "calibration/rig_observations.hpp"
#include "detection/rows_needed.hpp"

namespace telehug {

BorderBand green_band(const ScreenSize& screen, ImageSize image, bool upside_down) {
  // Of an edge in the picture's middle: how many rows in front of it are looked at.
  constexpr double usual_px_per_mm = 3.3;  // in pictures of 1280 columns
  const double middle = 0.5 * image.height_px;
  const RowRange rows = rows_needed(BorderCurve({middle, 0}, image), image, usual_px_per_mm * image.width_px / 1280);
  const double top = middle - rows.first;

  const RigParameters rig = usual_rigs(screen, image).mean;
  const double reach = rig[RigParameter::focal_px] * rig[RigParameter::z0_mm];
  const double to_edge_mm = screen.height_mm - rig[RigParameter::y0_mm];
  const double to_middle_mm = 0.5 * screen.height_mm - rig[RigParameter::y0_mm];
  const double bottom = image.height_px - 1 - reach * (1 / to_middle_mm - 1 / to_edge_mm);

  const BorderBand band{top, std::max(bottom, top + 0.1 * image.height_px)};
  if (!upside_down) return band;
  return {image.height_px - 1 - band.bottom_px, image.height_px - 1 - band.top_px};
}

double roll_deg(const BorderLine& line) noexcept {
  return std::atan(line.slope) * 180 / std::numbers::pi;
}

CameraTurn turn_wanted(const BorderLine& line, const BorderBand& band, ImageSize image, bool upside_down) noexcept {
  const double row = line.v_at(0.5 * (image.width_px - 1));
  const auto screen_side = upside_down ? CameraTurn::towards_user : CameraTurn::towards_screen;
  const auto user_side = upside_down ? CameraTurn::towards_screen : CameraTurn::towards_user;
  if (row > band.bottom_px) return screen_side;
  if (row < band.top_px) return user_side;
  return std::abs(roll_deg(line)) > largest_roll_deg ? CameraTurn::level : CameraTurn::none;
}

}  // namespace telehug
