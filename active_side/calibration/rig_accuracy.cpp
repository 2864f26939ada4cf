// SPDX-License-Identifier: Apache-2.0
#include "calibration/rig_accuracy.hpp"

#include <array>
#include <cmath>

namespace telehug {
namespace {

// Change per unit, by central difference.
std::optional<ScreenPoint> slope(const std::optional<ScreenPoint>& ahead, const std::optional<ScreenPoint>& behind,
                                 double step) {
  if (!ahead || !behind) return std::nullopt;
  return ScreenPoint{(ahead->x_mm - behind->x_mm) / (2 * step), (ahead->y_mm - behind->y_mm) / (2 * step)};
}

bool tip_visible(const RigModel& model, const ScreenPoint& contact) {
  const auto tip = tip_of_contact(model.camera, model.contact_radius_mm, contact);
  const ImageSize image = model.camera.image();
  return tip && tip->u_px >= 0 && tip->u_px <= image.width_px - 1 && tip->v_px >= 0 && tip->v_px <= image.height_px - 1;
}

// The last visible place on the way from a visible one to another.
ScreenPoint last_visible(const RigModel& model, ScreenPoint visible, ScreenPoint other) {
  if (tip_visible(model, other)) return other;
  for (int i = 0; i < 30; ++i) {
    const ScreenPoint middle{0.5 * (visible.x_mm + other.x_mm), 0.5 * (visible.y_mm + other.y_mm)};
    (tip_visible(model, middle) ? visible : other) = middle;
  }
  return visible;
}

std::optional<ScreenPoint> visible_in_row(const RigModel& model, const ScreenSize& screen, double y_mm) {
  constexpr int places = 64;
  for (int i = 0; i <= places; ++i) {
    // From the middle outwards.
    const double part = 0.5 + (i % 2 == 0 ? 0.5 : -0.5) * i / places;
    const ScreenPoint place{part * screen.width_mm, y_mm};
    if (tip_visible(model, place)) return place;
  }
  return std::nullopt;
}

}  // namespace

std::optional<PredictedError> predicted_error_mm(const RigSolution& solution, const ScreenPoint& contact,
                                                 const TipNoise& noise) {
  const RigCamera& camera = solution.model.camera;
  const double radius_mm = solution.model.contact_radius_mm;
  const auto tip = tip_of_contact(camera, radius_mm, contact);
  if (!tip) return std::nullopt;

  std::array<ScreenPoint, RigParameter::count> by_parameter;
  for (std::size_t i = 0; i < by_parameter.size(); ++i) {
    const double step = 1e-3 * std::sqrt(solution.covariance[i][i]) + 1e-9;
    RigParameters ahead = solution.parameters, behind = solution.parameters;
    ahead[i] += step;
    behind[i] -= step;
    const auto change = slope(make_rig_model(ahead, camera.image(), camera.orientation()).screen_point(*tip),
                              make_rig_model(behind, camera.image(), camera.orientation()).screen_point(*tip), step);
    if (!change) return std::nullopt;
    by_parameter[i] = *change;
  }
  double xx = 0, yy = 0;
  for (std::size_t i = 0; i < by_parameter.size(); ++i) {
    for (std::size_t k = 0; k < by_parameter.size(); ++k) {
      xx += by_parameter[i].x_mm * solution.covariance[i][k] * by_parameter[k].x_mm;
      yy += by_parameter[i].y_mm * solution.covariance[i][k] * by_parameter[k].y_mm;
    }
  }
  constexpr double px = 1e-3;
  const auto at = [&](double u, double v) { return solution.model.screen_point({tip->u_px + u, tip->v_px + v}); };
  const auto by_u = slope(at(px, 0), at(-px, 0), px);
  const auto by_v = slope(at(0, px), at(0, -px), px);
  if (!by_u || !by_v) return std::nullopt;
  const auto add = [&](const ScreenPoint& change, double sd) {
    xx += change.x_mm * change.x_mm * sd * sd;
    yy += change.y_mm * change.y_mm * sd * sd;
  };
  add(*by_u, noise.sigma_u_px);
  add(*by_v, noise.sigma_v_px);
  add(by_parameter[RigParameter::contact_radius_mm], noise.contact_radius_sd_mm);
  return PredictedError{std::sqrt(xx), std::sqrt(yy)};
}

std::vector<ErrorAt> error_map(const RigSolution& solution, const ScreenSize& screen, int columns, int rows,
                               const TipNoise& noise) {
  std::vector<ErrorAt> map;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const ScreenPoint place{(column + 0.5) * screen.width_mm / columns, (row + 0.5) * screen.height_mm / rows};
      if (!tip_visible(solution.model, place)) continue;
      if (const auto error = predicted_error_mm(solution, place, noise)) map.push_back({place, *error});
    }
  }
  return map;
}

Reach reach(const RigModel& model, const ScreenSize& screen) {
  constexpr int rows = 48;
  std::vector<ScreenPoint> left;  // from the bottom up
  std::vector<ScreenPoint> right;
  std::optional<ScreenPoint> seen;
  const auto add = [&](const ScreenPoint& place) {
    left.push_back(last_visible(model, place, {0, place.y_mm}));
    right.push_back(last_visible(model, place, {screen.width_mm, place.y_mm}));
  };
  for (int row = rows; row >= 0; --row) {
    const double y_mm = screen.height_mm * row / rows;
    const auto place = visible_in_row(model, screen, y_mm);
    if (place) add(*place);
    if (!place && seen) {
      add(last_visible(model, *seen, {seen->x_mm, y_mm}));
      break;
    }
    seen = place;
  }
  Reach found;
  if (left.empty()) return found;
  found.outline = left;
  found.outline.insert(found.outline.end(), right.rbegin(), right.rend());
  found.top_mm = left.back().y_mm;
  found.left_mm = left.front().x_mm;
  found.right_mm = right.front().x_mm;
  return found;
}

}  // namespace telehug
