// SPDX-License-Identifier: Apache-2.0
#include "setup/marks_camera.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "calibration/calibration_page.hpp"
#include "calibration/mark_search.hpp"
#include "calibration/rig_solver.hpp"

namespace telehug {
namespace {

// Cameras that are tried, as multiples of the usual focal length and distance: marks are found if one of them sees all
// that it sees within 0.4 of the marks' distance.
constexpr std::array focal_factors{0.75, 0.87, 1.0, 1.14, 1.3};
constexpr std::array distance_factors{0.55, 1.0, 1.5};
constexpr std::size_t tried = 8;  // of those that fit best and look at different places
constexpr std::size_t most_cameras = 3;

ImageSize size_of(const cv::Mat& bgr) {
  return {bgr.cols, bgr.rows};
}

RigModel aimed(RigParameters rig, const ScreenBorder& border, const ScreenSize& screen, ImageSize image,
               PictureOrientation orientation) {
  const double across = orientation.left_right_exchanged ? -1 : 1;
  const double middle_u_px = 0.5 * (image.width_px - 1);
  const ImagePoint vertex = border.vertex.value_or(ImagePoint{middle_u_px, border.line.v_at(middle_u_px)});
  rig[RigParameter::roll_deg] = across * std::atan(border.line.slope) * 180 / CV_PI;
  // Where the vertex is seen can be the camera's turn or its place: half of each.
  const double away = screen.height_mm - rig[RigParameter::y0_mm];
  rig[RigParameter::x0_mm] =
      0.5 * screen.width_mm + 0.5 * across * (vertex.u_px - middle_u_px) * away / rig[RigParameter::focal_px];
  constexpr int steps = 8;
  for (int i = 0; i < steps; ++i) {
    const auto at =
        make_rig_model(rig, image, orientation).camera.project(ScreenPoint{0.5 * screen.width_mm, screen.height_mm});
    if (!at) break;
    const double deg_per_px = 180 / CV_PI / rig[RigParameter::focal_px];
    // Turning the camera to the user moves the screen down in the picture; to the user's left, to the picture's left.
    rig[RigParameter::pitch_deg] += deg_per_px * (vertex.v_px - at->v_px);
    rig[RigParameter::yaw_deg] -= across * deg_per_px * (vertex.u_px - at->u_px);
  }
  return make_rig_model(rig, image, orientation);
}

// How well the spots lie where this camera sees marks: 1 for each that lies on one, less for each mark without a spot.
double likeness(const std::vector<ImagePoint>& spots, const ScreenSize& screen, const RigCamera& camera) {
  const std::vector<ScreenPoint> marks = mark_points(screen);
  const double reach_mm = 0.4 * std::abs(marks[1].x_mm - marks[0].x_mm);
  std::vector<double> nearest(marks.size(), 1);  // parts of the reach
  double found = 0;
  for (const ImagePoint& spot : spots) {
    const auto at = camera.screen_point(spot);
    if (!at) continue;
    double least = 1;
    for (std::size_t i = 0; i < marks.size(); ++i) {
      const double apart = std::hypot(at->x_mm - marks[i].x_mm, at->y_mm - marks[i].y_mm) / reach_mm;
      nearest[i] = std::min(nearest[i], apart);
      least = std::min(least, apart);
    }
    found += 1 - least * least;
  }
  double missed = 0;
  for (std::size_t i = 0; i < marks.size(); ++i) {
    if (nearest[i] == 1 && camera.sees(marks[i])) missed += 0.5;
  }
  return found - missed;
}

RigObservations observations(const EmptyScreenPictures& seen, std::vector<PointObservation> marks) {
  RigObservations all{seen.screen, size_of(seen.marks), {}, std::move(marks), {}};
  if (const auto vertex = triangle_mark(seen.border, seen.screen)) all.marks.push_back(*vertex);
  return all;
}

constexpr std::array slopes{0.0, -0.05, 0.05};  // of an edge that was not seen

// Where the middle of the screen's bottom edge is seen: at the vertex, else anywhere, 15 mm apart.
std::vector<ScreenBorder> possible_borders(const EmptyScreenPictures& seen, ImageSize image) {
  if (seen.border.vertex && seen.border.length_px > 0) return {seen.border};
  if (const auto& vertex = seen.border.vertex) {
    std::vector<ScreenBorder> borders;
    for (const double slope : slopes)
      borders.push_back({{vertex->v_px - slope * vertex->u_px, slope}, 0, vertex});
    return borders;
  }
  constexpr double usual_px_per_mm = 3.3;  // in pictures of 1280 columns
  const double step_px = 15 * usual_px_per_mm * image.width_px / 1280;
  std::vector<ScreenBorder> borders;
  for (int column = -3; column <= 3; ++column) {
    for (double row = 0.3; row < 0.9; row += 0.03) {
      for (const double slope : slopes) {
        const ImagePoint vertex{0.5 * image.width_px + column * step_px, row * image.height_px};
        borders.push_back({{vertex.v_px - slope * vertex.u_px, slope}, 0, vertex});
      }
    }
  }
  return borders;
}

struct Candidate {
  double likeness;
  RigCamera camera;
};

// In the middle of the screen's lower half.
bool sees_alike(const RigCamera& a, const RigCamera& b, const ScreenSize& screen) {
  constexpr double alike_mm = 20;
  const ScreenPoint place{0.5 * screen.width_mm, 0.8 * screen.height_mm};
  const auto at = a.project(place);
  const auto other = at ? b.screen_point(*at) : std::nullopt;
  return other && std::hypot(other->x_mm - place.x_mm, other->y_mm - place.y_mm) < alike_mm;
}

// Of those that look at the same place the first one.
void keep_different(std::vector<Candidate>& candidates, const ScreenSize& screen) {
  std::vector<Candidate> kept;
  for (const Candidate& candidate : candidates) {
    if (kept.size() == tried) break;
    const bool known = std::any_of(kept.begin(), kept.end(), [&](const Candidate& other) {
      return sees_alike(candidate.camera, other.camera, screen);
    });
    if (!known) kept.push_back(candidate);
  }
  candidates = std::move(kept);
}

struct Found {
  double likeness;
  RigCalibration camera;
};

// A camera that takes some marks for their neighbours sees others where there are none.
std::vector<RigCalibration> likeliest(std::vector<Found> found, const ScreenSize& screen) {
  std::stable_sort(found.begin(), found.end(), [](const Found& a, const Found& b) { return a.likeness > b.likeness; });
  std::vector<RigCalibration> cameras;
  for (Found& next : found) {
    if (cameras.size() == most_cameras) break;
    const bool known = std::any_of(cameras.begin(), cameras.end(), [&](const RigCalibration& other) {
      return sees_alike(next.camera.solution.model.camera, other.solution.model.camera, screen);
    });
    if (!known) cameras.push_back(std::move(next.camera));
  }
  return cameras;
}

}  // namespace

RigModel likely_camera(const ScreenBorder& border, const ScreenSize& screen, ImageSize image,
                       bool left_right_exchanged) {
  return aimed(usual_rigs(screen, image).mean, border, screen, image, {left_right_exchanged, false});
}

std::vector<RigCalibration> cameras_from_marks(const EmptyScreenPictures& seen, bool left_right_exchanged) {
  if (seen.marks.empty() || seen.marks.size() != seen.black.size()) return {};
  const ImageSize image = size_of(seen.marks);
  const PictureOrientation orientation{left_right_exchanged, false};
  const std::vector<ImagePoint> spots = lit_spots(seen.marks, seen.black);
  const auto near = [&](const RigCamera& camera) { return marks_at(spots, seen.screen, camera); };
  const auto solve = [&](std::vector<PointObservation> marks) -> std::optional<RigCalibration> {
    if (marks.empty()) return std::nullopt;
    RigObservations all = observations(seen, std::move(marks));
    auto solved = solve_rig(all, {std::nullopt, orientation});
    if (!solved) return std::nullopt;
    return RigCalibration{std::move(all), *std::move(solved)};
  };

  std::vector<Candidate> candidates;
  for (const ScreenBorder& border : possible_borders(seen, image)) {
    for (const double focal : focal_factors) {
      for (const double distance : distance_factors) {
        RigParameters rig = usual_rigs(seen.screen, image).mean;
        rig[RigParameter::focal_px] *= focal;
        rig[RigParameter::z0_mm] *= distance;
        const RigCamera camera = aimed(rig, border, seen.screen, image, orientation).camera;
        candidates.push_back({likeness(spots, seen.screen, camera), camera});
      }
    }
  }
  std::sort(candidates.begin(), candidates.end(),
            [](const Candidate& a, const Candidate& b) { return a.likeness > b.likeness; });
  keep_different(candidates, seen.screen);
  std::vector<Found> found;
  for (const Candidate& candidate : candidates) {
    const auto rough = solve(near(candidate.camera));
    if (!rough) continue;
    auto better = solve(near(rough->solution.model.camera));
    if (!better) continue;
    const RigCamera& camera = better->solution.model.camera;
    auto exact = solve(measured_marks(seen.marks, near(camera), seen.screen, camera));
    if (exact) better = std::move(exact);
    const double like = likeness(spots, seen.screen, better->solution.model.camera);
    found.push_back({like, *std::move(better)});
  }
  return likeliest(std::move(found), seen.screen);
}

Calibration as_calibration(const RigModel& model, const ScreenSize& screen) {
  RigSolution solution{model, {}, {}, {}, {}, 0, 0, 0};
  return {
      "", "", model.camera.image(), screen, border_line(model.camera, screen), RigCalibration{{}, std::move(solution)}};
}

}  // namespace telehug
