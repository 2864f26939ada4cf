// SPDX-License-Identifier: Apache-2.0
#include "body_map/vitruvian_grid.hpp"

#include <algorithm>
#include <cmath>

namespace telehug {
namespace {

// A last row lower than this share of a box is rounding, not a row.
constexpr double least_row_share = 1e-6;

int cell(double offset_mm, double side_mm, int count) {
  return std::clamp(static_cast<int>(std::floor(offset_mm / side_mm)), 0, count - 1);
}

// From the left edge of the screen to the way columns are counted, and back.
int counted(int column, const BodyMap& map) {
  return map.mirrored ? map.shape.columns - 1 - column : column;
}

ScreenRect common_part(const ScreenRect& a, const ScreenRect& b) {
  const double left = std::max(a.x_mm, b.x_mm);
  const double top = std::max(a.y_mm, b.y_mm);
  return {.x_mm = left,
          .y_mm = top,
          .width_mm = std::min(a.x_mm + a.width_mm, b.x_mm + b.width_mm) - left,
          .height_mm = std::min(a.y_mm + a.height_mm, b.y_mm + b.height_mm) - top};
}

bool is_empty(const ScreenRect& rect) {
  return !(rect.width_mm > 0) || !(rect.height_mm > 0);
}

bool inside(const ScreenPoint& point, const ScreenRect& rect) {
  return point.x_mm >= rect.x_mm && point.x_mm <= rect.x_mm + rect.width_mm && point.y_mm >= rect.y_mm &&
         point.y_mm <= rect.y_mm + rect.height_mm;
}

}  // namespace

std::optional<BodyMap> make_body_map(const ScreenRect& face, const ScreenRect& view, bool mirrored) {
  const double chin_mm = face.y_mm + face.height_mm;
  const double height_mm = view.y_mm + view.height_mm - chin_mm;
  if (!std::isfinite(face.x_mm) || !std::isfinite(face.width_mm) || !std::isfinite(height_mm) ||
      !std::isfinite(view.x_mm) || !std::isfinite(view.width_mm) || !(face.height_mm > 0) || !(face.width_mm >= 0) ||
      !(height_mm > 0)) {
    return std::nullopt;
  }
  const double side_mm = face.height_mm / 2;
  const double rows = std::max(1.0, std::ceil(height_mm / side_mm - least_row_share));
  if (rows > max_grid_rows) {
    return std::nullopt;
  }
  const double width_mm = grid_columns * side_mm;
  const ScreenRect grid{.x_mm = face.x_mm + face.width_mm / 2 - width_mm / 2,
                        .y_mm = chin_mm,
                        .width_mm = width_mm,
                        .height_mm = height_mm};
  const ScreenRect visible = common_part(grid, view);
  if (is_empty(visible)) {
    return std::nullopt;
  }
  return BodyMap{.version = 0,
                 .seen = {},
                 .face = face,
                 .grid = grid,
                 .visible = visible,
                 .shape = {.columns = grid_columns, .rows = static_cast<std::uint16_t>(rows)},
                 .box_side_mm = side_mm,
                 .mirrored = mirrored};
}

std::optional<BoxHit> box_at(const BodyMap& map, const ScreenPoint& point) {
  if (!inside(point, map.visible) || map.box_side_mm <= 0 || map.shape.columns == 0 || map.shape.rows == 0) {
    return std::nullopt;
  }
  const double x_mm = point.x_mm - map.grid.x_mm;
  const double y_mm = point.y_mm - map.grid.y_mm;
  const int column = counted(cell(x_mm, map.box_side_mm, map.shape.columns), map);
  const int row = cell(y_mm, map.box_side_mm, map.shape.rows);
  const double middle_mm = map.face.x_mm + map.face.width_mm / 2;
  const double right_fh = (point.x_mm - middle_mm) / map.face.height_mm;
  return BoxHit{.box = static_cast<std::uint16_t>(row * map.shape.columns + column + 1),
                .body = {.x_fh = map.mirrored ? -right_fh : right_fh, .y_fh = y_mm / map.face.height_mm}};
}

std::optional<ScreenRect> box_rect(const BodyMap& map, std::uint16_t box) {
  if (box < 1 || box > map.shape.columns * map.shape.rows) {
    return std::nullopt;
  }
  const int column = counted((box - 1) % map.shape.columns, map);
  const int row = (box - 1) / map.shape.columns;
  const ScreenRect whole{.x_mm = map.grid.x_mm + column * map.box_side_mm,
                         .y_mm = map.grid.y_mm + row * map.box_side_mm,
                         .width_mm = map.box_side_mm,
                         .height_mm = map.box_side_mm};
  const ScreenRect visible = common_part(whole, map.visible);
  return is_empty(visible) ? std::nullopt : std::optional(visible);
}

}  // namespace telehug
