// SPDX-License-Identifier: Apache-2.0
#include "calibration/dot_edges.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "calibration/dot_outline.hpp"
#include "calibration/whiteness.hpp"

namespace telehug {
namespace {

// Lengths in pixels are for pictures 1280 px wide.
constexpr double search_px = 2.5;       // an edge is looked for so far to both sides of the outline
constexpr double slope_px = 0.75;       // half the length over which the slope is taken
constexpr double step_px = 0.25;        // of the search
constexpr double margin_px = 14;        // of the looked-at part around the outline
constexpr double camera_blur_px = 0.9;  // standard deviation, lens and electronics
// Prior standard deviation of how much wider than drawn the dot's edge is.
constexpr double spread_sd_px = 0.5;
// An edge farther than this from the fitted outline is not the dot's.
constexpr double outlier_px = 1.0;
// A step of less than this share of the contrast is no edge of the dot.
constexpr double least_step = 0.2;
constexpr double least_score = 0.75;
// Across most of the visible outline the picture falls by this many grey levels at least: many times the noise, and
// more than most mirror images in a black screen do.
constexpr float least_fall = 20;
constexpr double fall_px = 1.5;  // to both sides of the outline
// What systematic errors leave: mirror images below the dot, the shape of the outline.
constexpr double floor_u_px = 0.1;
constexpr double floor_v_px = 0.2;
constexpr int rounds = 8;

struct Edge {
  double offset_px = 0;  // along the normal, outwards
  double height = 0;     // how far the picture falls there
};

// `value` gives the picture's whiteness at a distance along the normal.
template <typename Value>
std::optional<Edge> steepest_fall(Value value, double scale) {
  constexpr int side = static_cast<int>(search_px / step_px);
  std::array<double, 2 * side + 1> fall{};
  for (std::size_t i = 0; i < fall.size(); ++i) {
    const double d = (static_cast<double>(i) - side) * step_px;
    fall[i] = value((d - slope_px) * scale) - value((d + slope_px) * scale);
  }
  const auto best = std::max_element(fall.begin(), fall.end());
  if (best == fall.begin() || best == fall.end() - 1 || *best <= 0) return std::nullopt;
  const double before = best[-1], after = best[1];
  const double bend = before - 2 * *best + after;
  const double between = bend < 0 ? 0.5 * (before - after) / bend : 0;
  return Edge{(static_cast<double>(best - fall.begin() - side) + between) * step_px * scale, *best};
}

cv::Rect around(const DotOutline& outline, double margin) {
  double left = outline.points[0].image.u_px, right = left;
  double top = outline.points[0].image.v_px, bottom = top;
  for (const DotOutline::Point& point : outline.points) {
    left = std::min(left, point.image.u_px), right = std::max(right, point.image.u_px);
    top = std::min(top, point.image.v_px), bottom = std::max(bottom, point.image.v_px);
  }
  const auto low = [&](double value) { return static_cast<int>(std::floor(value - margin)); };
  const auto high = [&](double value) { return static_cast<int>(std::ceil(value + margin)) + 1; };
  return {cv::Point(low(left), low(top)), cv::Point(high(right), high(bottom))};
}

// The dot as a camera with this blur would show it, white 1 and black 0.
cv::Mat draw(const DotOutline& outline, const cv::Rect& part, double blur_px) {
  constexpr int fine = 8;        // parts of a pixel
  constexpr int fixed_bits = 8;  // of OpenCV's coordinates
  std::vector<cv::Point> corners;
  for (const DotOutline::Point& point : outline.points) {
    const auto fixed = [&](double value, int origin) {
      return static_cast<int>(std::lround(((value - origin + 0.5) * fine - 0.5) * (1 << fixed_bits)));
    };
    corners.emplace_back(fixed(point.image.u_px, part.x), fixed(point.image.v_px, part.y));
  }
  cv::Mat large(part.size() * fine, CV_8UC1, cv::Scalar(0));
  cv::fillPoly(large, std::vector<std::vector<cv::Point>>{corners}, cv::Scalar(255), cv::LINE_AA, fixed_bits);
  cv::Mat drawn;
  cv::resize(large, drawn, part.size(), 0, 0, cv::INTER_AREA);
  drawn.convertTo(drawn, CV_32FC1, 1 / 255.0);
  cv::GaussianBlur(drawn, drawn, {}, blur_px);
  return drawn;
}

struct Measured {
  const DotOutline::Point* point;
  double offset_px;  // of the picture's edge from the drawing's
  double weight;
};

struct Fit {
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();  // u, v, and the edge's spread
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity();
  double inliers = 0;
};

Fit fit_shift(const std::vector<Measured>& edges, double scale) {
  Fit fit;
  std::vector<double> trust(edges.size(), 1.0);
  for (int round = 0; round < rounds; ++round) {
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    normal(2, 2) = 1 / (spread_sd_px * spread_sd_px * scale * scale);
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    double squares = 0, weights = 0;
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const Eigen::Vector3d row(edges[i].point->normal_u, edges[i].point->normal_v, 1);
      const double weight = edges[i].weight * trust[i];
      normal += weight * row * row.transpose();
      right += weight * edges[i].offset_px * row;
    }
    fit.shift = normal.ldlt().solve(right);
    fit.inliers = 0;
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const Eigen::Vector3d row(edges[i].point->normal_u, edges[i].point->normal_v, 1);
      const double residual = edges[i].offset_px - row.dot(fit.shift);
      // Tukey's biweight.
      const double x = residual / (2 * outlier_px * scale);
      trust[i] = std::abs(x) < 1 ? (1 - x * x) * (1 - x * x) : 0;
      squares += edges[i].weight * trust[i] * residual * residual;
      weights += edges[i].weight * trust[i];
      if (std::abs(residual) < outlier_px * scale) fit.inliers += 1;
    }
    // Neighbouring edges share their pixels: about every third one counts.
    fit.covariance = normal.inverse() * (3 * squares / std::max(weights, 1e-9));
  }
  return fit;
}

// A fingertip's rounded lower end looks like the dot's arc, but it has no ends.
bool is_clear(const Whiteness& white, const DotOutline& outline, double scale) {
  constexpr double end = 0.2;  // sine, towards the camera, from which on an arc is no end
  struct Count {
    int visible = 0;
    int clear = 0;
    [[nodiscard]] double share() const { return visible > 0 ? static_cast<double>(clear) / visible : 0; }
  };
  Count all, left_end, right_end;
  for (const DotOutline::Point& point : outline.points) {
    if (!DotOutline::is_visible(point)) continue;
    const bool falls = white.at(point.along(-fall_px * scale)) - white.at(point.along(fall_px * scale)) >= least_fall;
    Count& ends = point.cosine < 0 ? left_end : right_end;
    for (Count* count : {&all, &ends}) {
      if (count == &ends && point.sine < -end) continue;
      ++count->visible;
      if (falls) ++count->clear;
    }
  }
  return all.share() >= 0.75 && left_end.share() >= 0.5 && right_end.share() >= 0.5;
}

// Of every visible point of the outline whose surroundings are in the picture and show an edge.
std::vector<Measured> measure(const Whiteness& white, const DotOutline& outline, ImageSize image) {
  const double scale = picture_scale(image);
  const cv::Rect part = around(outline, margin_px * scale);
  const cv::Mat drawn = draw(outline, part, std::hypot(camera_blur_px * scale, Whiteness::blur_px(image)));
  std::vector<Measured> edges;
  for (const DotOutline::Point& point : outline.points) {
    if (!DotOutline::is_visible(point)) continue;
    if (!white.contains(point.along((search_px + slope_px) * scale))) continue;
    const auto seen = steepest_fall([&](double d) { return white.at(point.along(d)); }, scale);
    const auto model = steepest_fall(
        [&](double d) {
          const ImagePoint at = point.along(d);
          return value_at(drawn, at.u_px - part.x, at.v_px - part.y);
        },
        scale);
    if (!seen || !model) continue;
    const double height = seen->height / std::max(1.0F, white.contrast());
    if (height < least_step * model->height) continue;
    edges.push_back({&point, seen->offset_px - model->offset_px, std::min(1.0, height)});
  }
  return edges;
}

}  // namespace

std::optional<CalibrationDot> fit_dot_edges(const cv::Mat& bgr, const RigCamera& camera, const ImagePoint& near,
                                            double diameter_mm) {
  const ImageSize image{bgr.cols, bgr.rows};
  const double scale = picture_scale(image);
  auto outline = dot_outline(camera, near, diameter_mm);
  if (!outline) return std::nullopt;
  const Whiteness white(bgr, around(*outline, margin_px * scale));
  if (white.part().empty()) return std::nullopt;
  const auto expected =
      static_cast<double>(std::count_if(outline->points.begin(), outline->points.end(), DotOutline::is_visible));

  CalibrationDot dot{near};
  for (int round = 0; round < rounds; ++round) {
    const std::vector<Measured> edges = measure(white, *outline, image);
    if (static_cast<double>(edges.size()) < least_score * expected) return std::nullopt;
    const Fit fit = fit_shift(edges, scale);
    // One step is at most as long as the edges are looked for.
    const double length = std::hypot(fit.shift[0], fit.shift[1]);
    const double part_of_it = std::min(1.0, search_px * scale / std::max(length, 1e-9));
    dot.centre.u_px += part_of_it * fit.shift[0];
    dot.centre.v_px += part_of_it * fit.shift[1];
    dot.sigma_u_px = std::hypot(std::sqrt(fit.covariance(0, 0)), floor_u_px * scale);
    dot.sigma_v_px = std::hypot(std::sqrt(fit.covariance(1, 1)), floor_v_px * scale);
    dot.score = fit.inliers / expected;
    outline = dot_outline(camera, dot.centre, diameter_mm);
    if (!outline) return std::nullopt;
    if (length < 0.01 * scale) break;
  }
  if (dot.score < least_score || !is_clear(white, *outline, scale)) return std::nullopt;
  return dot;
}

}  // namespace telehug
