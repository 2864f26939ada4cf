// SPDX-License-Identifier: Apache-2.0
#include "calibration/mark_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "calibration/calibration_dot.hpp"
#include "calibration/calibration_page.hpp"
#include "calibration/consistent_touches.hpp"
#include "calibration/whiteness.hpp"

namespace telehug {
namespace {

// Many times the noise.
constexpr double least_rise = 30;
// In pictures 1280 px wide.
constexpr double least_area_px = 20;  // of a spot
constexpr double spot_sigma_px = 1;   // of its middle: the image of a dot's centre lies elsewhere
// A spot farther than this part of the marks' distance from where a mark is expected is not the mark.
constexpr double reach = 0.4;
constexpr std::size_t least_marks = 5;

double least_distance(const std::vector<ScreenPoint>& points, double ScreenPoint::*coordinate) {
  double least = std::numeric_limits<double>::infinity();
  for (const ScreenPoint& point : points) {
    const double apart = std::abs(point.*coordinate - points.front().*coordinate);
    if (apart > 0) least = std::min(least, apart);
  }
  return least;
}

std::vector<PointObservation> consistent(const std::vector<PointObservation>& marks, const ScreenSize& screen,
                                         ImageSize image) {
  std::vector<PointObservation> found;
  if (marks.size() < least_marks) return found;
  for (const std::size_t i : consistent_touches({screen, image, marks, {}, {}}))
    found.push_back(marks[i]);
  if (found.size() < least_marks) found.clear();
  return found;
}

}  // namespace

std::vector<ImagePoint> lit_spots(const cv::Mat& shown, const cv::Mat& empty) {
  cv::Mat risen;
  cv::subtract(shown, empty, risen);
  std::array<cv::Mat, 3> colours;
  cv::split(risen, colours);
  const cv::Mat lit = cv::min(cv::min(colours[0], colours[1]), colours[2]) >= least_rise;
  cv::Mat labels, boxes, middles;
  const int count = cv::connectedComponentsWithStats(lit, labels, boxes, middles);
  const double scale = picture_scale({shown.cols, shown.rows});
  const cv::Rect within(1, 1, shown.cols - 2, shown.rows - 2);
  std::vector<ImagePoint> spots;
  for (int i = 1; i < count; ++i) {  // 0 is what is not lit
    const int* const box = boxes.ptr<int>(i);
    const cv::Rect place(box[cv::CC_STAT_LEFT], box[cv::CC_STAT_TOP], box[cv::CC_STAT_WIDTH], box[cv::CC_STAT_HEIGHT]);
    if (box[cv::CC_STAT_AREA] >= least_area_px * scale * scale && (place & within) == place)
      spots.push_back({middles.at<double>(i, 0), middles.at<double>(i, 1)});
  }
  return spots;
}

std::vector<PointObservation> marks_at(const std::vector<ImagePoint>& spots, const ScreenSize& screen,
                                       const RigCamera& camera) {
  const std::vector<ScreenPoint> points = mark_points(screen);
  const double reach_x_mm = reach * least_distance(points, &ScreenPoint::x_mm);
  const double reach_y_mm = reach * least_distance(points, &ScreenPoint::y_mm);
  const double sigma_px = spot_sigma_px * picture_scale(camera.image());
  std::vector<PointObservation> marks;
  for (const ScreenPoint& point : points) {
    const ImagePoint* nearest = nullptr;
    double nearest_apart = 1;  // parts of what is reached
    for (const ImagePoint& spot : spots) {
      const auto at = camera.screen_point(spot);
      if (!at) continue;
      const double apart = std::hypot((at->x_mm - point.x_mm) / reach_x_mm, (at->y_mm - point.y_mm) / reach_y_mm);
      if (apart < nearest_apart) nearest = &spot, nearest_apart = apart;
    }
    if (nearest != nullptr) marks.push_back({point, *nearest, sigma_px, sigma_px, TouchEvidence::dot});
  }
  return consistent(marks, screen, camera.image());
}

std::vector<PointObservation> measured_marks(const cv::Mat& shown, const std::vector<PointObservation>& marks,
                                             const ScreenSize& screen, const RigCamera& camera) {
  std::vector<PointObservation> measured;
  for (const PointObservation& mark : marks) {
    if (const auto dot = refine_calibration_dot(shown, camera, mark.image))
      measured.push_back({mark.screen, dot->centre, dot->sigma_u_px, dot->sigma_v_px, TouchEvidence::dot});
  }
  return consistent(measured, screen, camera.image());
}

}  // namespace telehug
