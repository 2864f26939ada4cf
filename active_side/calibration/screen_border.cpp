// SPDX-License-Identifier: Apache-2.0
#include "calibration/screen_border.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <utility>

#include "calibration/line_segments.hpp"

namespace telehug {
namespace {

constexpr double level_limit_deg = 6;
constexpr double same_level_px = 4;
// A border shorter than this part of the picture's width is none: the screen is wider than what the camera sees.
constexpr double least_part_of_width = 0.4;
// Edges of the triangle: clearly inclined, not upright (a monitor's foot), and of a visible length.
constexpr double triangle_least_deg = 9;
constexpr double triangle_largest_deg = 80;
constexpr double triangle_least_length_px = 50;
// How far from a line the intersection of the triangle's edges may lie.
constexpr double vertex_limit_px = 12;

// Noise breaks lines up: lengths that differ by less than this part are equal. Of equal lines the lowest is taken,
// since keyboards, desk edges and the bezel's upper edge all lie above the screen's own in the picture.
constexpr double equal_length_part = 0.1;

double distance_px(const BorderLine& line, const ImagePoint& point) {
  return std::abs(point.v_px - line.v_at(point.u_px));
}

BorderLine line_through(const LineSegment& segment) {
  const double slope = (segment.right.v_px - segment.left.v_px) / std::max(1.0, segment.right.u_px - segment.left.u_px);
  return {segment.left.v_px - slope * segment.left.u_px, slope};
}

// Least squares through the segments as if each were a row of points, one per column.
BorderLine fit(const std::vector<LineSegment>& segments) {
  double n = 0, su = 0, sv = 0, suu = 0, suv = 0;
  for (const LineSegment& segment : segments) {
    const BorderLine line = line_through(segment);
    for (double u = segment.left.u_px; u <= segment.right.u_px; u += 1.0) {
      const double v = line.v_at(u);
      n += 1, su += u, sv += v, suu += u * u, suv += u * v;
    }
  }
  const double determinant = n * suu - su * su;
  const double slope = determinant > 0 ? (n * suv - su * sv) / determinant : 0.0;
  return {(sv - slope * su) / n, slope};
}

double covered_columns(const std::vector<LineSegment>& segments) {
  std::vector<std::pair<double, double>> spans;
  spans.reserve(segments.size());
  for (const LineSegment& segment : segments)
    spans.emplace_back(segment.left.u_px, segment.right.u_px);
  std::sort(spans.begin(), spans.end());
  double covered = 0;
  double end = -1;
  for (const auto& [left, right] : spans) {
    covered += std::max(0.0, right - std::max(left, end));
    end = std::max(end, right);
  }
  return covered;
}

std::vector<LevelLine> merge_by_level(std::vector<LineSegment> segments) {
  std::erase_if(segments, [](const LineSegment& s) { return std::abs(inclination_deg(s)) > level_limit_deg; });
  std::sort(segments.begin(), segments.end(),
            [](const LineSegment& a, const LineSegment& b) { return length_px(a) > length_px(b); });
  std::vector<LevelLine> lines;
  while (!segments.empty()) {
    // The longest piece left takes all that lie at its level; the line grows with them.
    std::vector<LineSegment> members{segments.front()};
    segments.erase(segments.begin());
    BorderLine line = fit(members);
    for (bool grown = true; grown;) {
      const auto at_level = [&line](const LineSegment& s) {
        return distance_px(line, s.left) <= same_level_px && distance_px(line, s.right) <= same_level_px;
      };
      std::copy_if(segments.begin(), segments.end(), std::back_inserter(members), at_level);
      grown = std::erase_if(segments, at_level) > 0;
      if (grown) line = fit(members);
    }
    lines.push_back({line, covered_columns(members)});
  }
  std::sort(lines.begin(), lines.end(),
            [](const LevelLine& a, const LevelLine& b) { return a.length_px > b.length_px; });
  return lines;
}

std::optional<ImagePoint> intersection(const LineSegment& a, const LineSegment& b) {
  const double au = a.right.u_px - a.left.u_px;
  const double av = a.right.v_px - a.left.v_px;
  const double bu = b.right.u_px - b.left.u_px;
  const double bv = b.right.v_px - b.left.v_px;
  const double cross = au * bv - av * bu;
  if (std::abs(cross) < 1e-9) return std::nullopt;
  const double t = ((b.left.u_px - a.left.u_px) * bv - (b.left.v_px - a.left.v_px) * bu) / cross;
  return ImagePoint{a.left.u_px + t * au, a.left.v_px + t * av};
}

const LevelLine* nearest_line(const std::vector<LevelLine>& lines, const ImagePoint& point, double least_length_px) {
  const LevelLine* nearest = nullptr;
  for (const LevelLine& line : lines) {
    if (line.length_px < least_length_px || distance_px(line.line, point) > vertex_limit_px) continue;
    if (nearest == nullptr || distance_px(line.line, point) < distance_px(nearest->line, point)) nearest = &line;
  }
  return nearest;
}

// Two edges that meet as the triangle's do: one falls to the left of the vertex, one to its right.
struct TriangleEdges {
  LineSegment left;
  LineSegment right;
  ImagePoint vertex;
  [[nodiscard]] double length() const { return length_px(left) + length_px(right); }
};

// The longest first. Of rolled cameras one edge may be as level as borders are.
std::vector<TriangleEdges> possible_triangles(const std::vector<LineSegment>& segments, double least_deg) {
  std::vector<LineSegment> edges;
  for (const LineSegment& segment : segments) {
    const double deg = std::abs(inclination_deg(segment));
    if (deg >= least_deg && deg <= triangle_largest_deg && length_px(segment) >= triangle_least_length_px) {
      edges.push_back(segment);
    }
  }
  std::vector<TriangleEdges> found;
  for (const LineSegment& left : edges) {
    if (inclination_deg(left) > 0) continue;  // rises to the right, to the vertex
    for (const LineSegment& right : edges) {
      if (inclination_deg(right) < 0) continue;
      const auto vertex = intersection(left, right);
      if (!vertex || vertex->u_px + vertex_limit_px < left.right.u_px ||
          vertex->u_px - vertex_limit_px > right.left.u_px) {
        continue;
      }
      found.push_back({left, right, *vertex});
    }
  }
  std::sort(found.begin(), found.end(),
            [](const TriangleEdges& a, const TriangleEdges& b) { return a.length() > b.length(); });
  return found;
}

// The line on which the triangle's edges meet.
std::optional<ScreenBorder> line_at_triangle(const std::vector<LineSegment>& segments,
                                             const std::vector<LevelLine>& lines, double least_length_px) {
  for (const TriangleEdges& triangle : possible_triangles(segments, triangle_least_deg)) {
    const LevelLine* line = nearest_line(lines, triangle.vertex, least_length_px);
    if (line != nullptr) return ScreenBorder{line->line, line->length_px, triangle.vertex};
  }
  return std::nullopt;
}

// Whether it is darker below this edge than above it, all along it.
bool darker_below(const cv::Mat& grey, const LineSegment& edge) {
  constexpr double aside_px = 12;
  constexpr double darker = 0.85;
  const double length = length_px(edge);
  const double across_u = -(edge.right.v_px - edge.left.v_px) / length * aside_px;
  const double across_v = (edge.right.u_px - edge.left.u_px) / length * aside_px;
  const auto light = [&](double u, double v) {
    const cv::Rect part = cv::Rect(static_cast<int>(u) - 3, static_cast<int>(v) - 3, 7, 7) & cv::Rect({}, grey.size());
    return part.empty() ? 0 : cv::mean(grey(part))[0];
  };
  for (const double along : {0.25, 0.5, 0.75}) {
    const double u = edge.left.u_px + along * (edge.right.u_px - edge.left.u_px);
    const double v = edge.left.v_px + along * (edge.right.v_px - edge.left.v_px);
    if (light(u + across_u, v + across_v) > darker * light(u - across_u, v - across_v)) return false;
  }
  return true;
}

std::optional<ScreenBorder> triangle_alone(const cv::Mat& bgr, const std::vector<LineSegment>& segments,
                                           const std::vector<LevelLine>& lines) {
  // The whole triangle reaches over some of the screen: short pairs are things on the desk.
  constexpr double least_part = 0.2;  // of the picture's width, both edges together
  constexpr double least_between_deg = 10;
  constexpr double largest_gap_part = 0.2;  // of the picture's width, between an edge that was found and the vertex
  constexpr double farthest_part = 0.15;  // of the picture's height, that the bezel's edges are away from the screen's
  cv::Mat grey;
  cv::cvtColor(bgr, grey, cv::COLOR_BGR2GRAY);
  for (const TriangleEdges& triangle : possible_triangles(segments, 0)) {
    if (triangle.length() < least_part * bgr.cols) break;
    if (inclination_deg(triangle.right) - inclination_deg(triangle.left) < least_between_deg) continue;
    const double gap_px =
        std::max(triangle.vertex.u_px - triangle.left.right.u_px, triangle.right.left.u_px - triangle.vertex.u_px);
    if (gap_px > largest_gap_part * bgr.cols) continue;
    if (!darker_below(grey, triangle.left) || !darker_below(grey, triangle.right)) continue;
    const ImagePoint& vertex = triangle.vertex;
    if (vertex.u_px < 0 || vertex.v_px < 0 || vertex.u_px >= bgr.cols || vertex.v_px >= bgr.rows) continue;
    const auto level = std::find_if(lines.begin(), lines.end(), [&](const LevelLine& line) {
      return line.length_px >= least_part_of_width * bgr.cols &&
             distance_px(line.line, vertex) < farthest_part * bgr.rows;
    });
    const double slope = level == lines.end() ? 0 : level->line.slope;
    return ScreenBorder{{vertex.v_px - slope * vertex.u_px, slope}, 0, vertex};
  }
  return std::nullopt;
}

// `lines` is sorted, the longest first, and not empty.
const LevelLine* longest_line(const std::vector<LevelLine>& lines, double middle_u_px) {
  const LevelLine* lowest = &lines.front();
  for (const LevelLine& line : lines) {
    if (line.length_px < (1 - equal_length_part) * lines.front().length_px) break;
    if (line.line.v_at(middle_u_px) > lowest->line.v_at(middle_u_px)) lowest = &line;
  }
  return lowest;
}

}  // namespace

std::vector<LevelLine> find_level_lines(const cv::Mat& bgr) {
  return merge_by_level(find_line_segments(bgr));
}

std::optional<PointObservation> triangle_mark(const ScreenBorder& border, const ScreenSize& screen) {
  // Two lines some pixels wide meet there, and more steeply in u than in v.
  constexpr double sigma_u_px = 1.5;
  constexpr double sigma_v_px = 4;
  if (!border.vertex) return std::nullopt;
  return PointObservation{{0.5 * screen.width_mm, screen.height_mm}, *border.vertex, sigma_u_px, sigma_v_px};
}

Result<ScreenBorder> find_screen_border(const cv::Mat& bgr, BorderChoice choice) {
  if (bgr.empty() || bgr.type() != CV_8UC3) return Error{"there is no colour picture in which to find the border"};
  const auto segments = find_line_segments(bgr);
  const auto lines = merge_by_level(segments);
  const double least_length_px = least_part_of_width * bgr.cols;
  if (choice == BorderChoice::triangle_alone) {
    if (const auto border = triangle_alone(bgr, segments, lines)) return *border;
    return Error{"no triangle found: show it on the whole screen, with its point in the camera's view"};
  }
  if (lines.empty() || lines.front().length_px < least_length_px) {
    return Error{
        fmt::format("no border of the screen found: the longest level line covers {:.0f} of {} columns; let "
                    "the camera look straight down along the screen and light the desk",
                    lines.empty() ? 0.0 : lines.front().length_px, bgr.cols)};
  }
  if (choice == BorderChoice::longest) {
    const LevelLine* const line = longest_line(lines, 0.5 * bgr.cols);
    return ScreenBorder{line->line, line->length_px, std::nullopt};
  }
  const auto border = line_at_triangle(segments, lines, least_length_px);
  if (!border) {
    return Error{fmt::format(
        "none of {} level lines carries the triangle's vertex: show the triangle with its point on the screen's bottom "
        "edge, in the camera's view",
        lines.size())};
  }
  return *border;
}

}  // namespace telehug
