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

}  // namespace

std::optional<BodyMap> make_body_map(const ScreenRect& face, double bottom_mm) {
  const double chin_mm = face.y_mm + face.height_mm;
  const double height_mm = bottom_mm - chin_mm;
  if (!std::isfinite(face.x_mm) || !std::isfinite(face.width_mm) || !std::isfinite(height_mm) ||
      !(face.height_mm > 0) || !(face.width_mm >= 0) || !(height_mm > 0)) {
    return std::nullopt;
  }
  const double side_mm = face.height_mm / 2;
  const double rows = std::max(1.0, std::ceil(height_mm / side_mm - least_row_share));
  if (rows > max_grid_rows) {
    return std::nullopt;
  }
  const double width_mm = grid_columns * side_mm;
  return BodyMap{.version = 0,
                 .seen = {},
                 .face = face,
                 .grid = {.x_mm = face.x_mm + face.width_mm / 2 - width_mm / 2,
                          .y_mm = chin_mm,
                          .width_mm = width_mm,
                          .height_mm = height_mm},
                 .shape = {.columns = grid_columns, .rows = static_cast<std::uint16_t>(rows)},
                 .box_side_mm = side_mm};
}

std::optional<BoxHit> box_at(const BodyMap& map, const ScreenPoint& point) {
  const double x_mm = point.x_mm - map.grid.x_mm;
  const double y_mm = point.y_mm - map.grid.y_mm;
  const bool inside = x_mm >= 0 && x_mm <= map.grid.width_mm && y_mm >= 0 && y_mm <= map.grid.height_mm;
  if (!inside || map.box_side_mm <= 0 || map.shape.columns == 0 || map.shape.rows == 0) {
    return std::nullopt;
  }
  const int column = cell(x_mm, map.box_side_mm, map.shape.columns);
  const int row = cell(y_mm, map.box_side_mm, map.shape.rows);
  const double middle_mm = map.face.x_mm + map.face.width_mm / 2;
  return BoxHit{.box = static_cast<std::uint16_t>(row * map.shape.columns + column + 1),
                .body = {.x_fh = (point.x_mm - middle_mm) / map.face.height_mm, .y_fh = y_mm / map.face.height_mm}};
}

std::optional<ScreenRect> box_rect(const BodyMap& map, std::uint16_t box) {
  if (box < 1 || box > map.shape.columns * map.shape.rows) {
    return std::nullopt;
  }
  const int column = (box - 1) % map.shape.columns;
  const int row = (box - 1) / map.shape.columns;
  const double top_mm = row * map.box_side_mm;
  return ScreenRect{.x_mm = map.grid.x_mm + column * map.box_side_mm,
                    .y_mm = map.grid.y_mm + top_mm,
                    .width_mm = map.box_side_mm,
                    .height_mm = std::min(map.box_side_mm, map.grid.height_mm - top_mm)};
}

}  // namespace telehug
