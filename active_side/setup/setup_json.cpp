// SPDX-License-Identifier: Apache-2.0
#include "setup/setup_json.hpp"

#include "calibration/calibration_page.hpp"

namespace telehug {
namespace {

using nlohmann::json;

json pair_of(const ScreenPoint& point) {
  return json::array({point.x_mm, point.y_mm});
}

json pair_of(const ImagePoint& point) {
  return json::array({point.u_px, point.v_px});
}

template <typename Point>
json or_null(const std::optional<Point>& point) {
  return point ? pair_of(*point) : json();
}

template <typename Point>
json pairs_of(const std::vector<Point>& points) {
  json list = json::array();
  for (const Point& point : points)
    list.push_back(pair_of(point));
  return list;
}

json shown(const SetupState& state, const ScreenSize& screen) {
  json triangle = json::array();
  if (state.page == SetupPage::triangle) {
    for (const PartOfScreen& corner : calibration_triangle)
      triangle.push_back(pair_of(ScreenPoint{corner.x * screen.width_mm, corner.y * screen.height_mm}));
  }
  std::vector<ScreenPoint> dots;
  if (state.page == SetupPage::marks) dots = mark_points(screen);
  if (state.page == SetupPage::dot && state.dot < state.dots.size()) dots = {state.dots[state.dot]};
  return {{"page", name_of(state.page)}, {"width_mm", screen.width_mm}, {"height_mm", screen.height_mm},
          {"triangle", triangle},        {"dots", pairs_of(dots)},      {"dot_mm", calibration_dot_mm}};
}

json border_json(const SeenBorder& border) {
  return {{"points", pairs_of(border.points_px)},
          {"vertex", or_null(border.vertex_px)},
          {"roll_deg", border.roll_deg},
          {"in_band", border.in_band}};
}

json errors_json(const SetupErrorMap& map) {
  json horizontal = json::array(), vertical = json::array();
  for (const auto& field : map.fields) {
    horizontal.push_back(field ? json(field->horizontal_mm) : json());
    vertical.push_back(field ? json(field->vertical_mm) : json());
  }
  return {{"columns", map.columns}, {"rows", map.rows}, {"horizontal_mm", horizontal}, {"vertical_mm", vertical}};
}

json result_json(const SetupResult& result) {
  json dots = json::array();
  for (const DotOutcome& dot : result.dots) {
    dots.push_back({{"x_mm", dot.dot.x_mm},
                    {"y_mm", dot.dot.y_mm},
                    {"used", dot.used},
                    {"skipped", dot.skipped},
                    {"error_mm", or_null(dot.error_mm)}});
  }
  return {{"good", result.good()},
          {"dots", dots},
          {"repeat", result.repeat},
          {"faults", result.faults},
          {"remarks", result.remarks},
          {"reach", pairs_of(result.reach.outline)},
          {"errors", errors_json(result.errors)}};
}

}  // namespace

json setup_json(const SetupState& state, const ScreenSize& screen) {
  const json band = state.green_band
                        ? json{{"top_px", state.green_band->top_px}, {"bottom_px", state.green_band->bottom_px}}
                        : json();
  return {
      {"step", name_of(state.step)},
      {"show", shown(state, screen)},
      {"advice", name_of(state.advice)},
      {"progress", state.progress},
      {"image", {{"width_px", state.image.width_px}, {"height_px", state.image.height_px}}},
      {"green_band", band},
      {"border", state.border ? border_json(*state.border) : json()},
      {"camera_known", state.camera_known},
      {"dots", pairs_of(state.dots)},
      {"dot", state.dot},
      {"taken", state.taken},
      {"finger", or_null(state.finger_px)},
      {"off_mm", or_null(state.off_mm)},
      {"can",
       {{"confirm", state.can_confirm}, {"back", state.can_back}, {"skip", state.can_skip}, {"save", state.can_save}}},
      {"result", state.result ? result_json(*state.result) : json()}};
}

}  // namespace telehug
