// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>

#include "body_map/body_map.hpp"
#include "body_map/screen_scale.hpp"

namespace telehug {

// Where face and grid are, for programs that draw them: {"face": {"x", "y", "w", "h"}, "grid": the same, "visible": the
// same, "columns", "rows", "box_px", "mirrored"}; px of the monitor. For maps with a version only.
[[nodiscard]] inline nlohmann::json body_map_json(const BodyMap& map, const ScreenScale& scale) {
  const auto rect = [&scale](const ScreenRect& mm) -> nlohmann::json {
    const cv::Rect2d px = scale.to_px(mm);
    return {{"x", px.x}, {"y", px.y}, {"w", px.width}, {"h", px.height}};
  };
  return {{"face", rect(map.face)},       {"grid", rect(map.grid)}, {"visible", rect(map.visible)},
          {"columns", map.shape.columns}, {"rows", map.shape.rows}, {"box_px", map.box_side_mm / scale.mm_per_px_y},
          {"mirrored", map.mirrored}};
}

}  // namespace telehug
