// SPDX-License-Identifier: Apache-2.0
#include "calibration/line_segments.hpp"

#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

namespace telehug {
namespace {

// Chosen on both sample rigs: below these, noise and the grain of a desk bend the lines; above, a black bezel's edge on
// a black screen is lost.
constexpr double canny_low = 25;
constexpr double canny_high = 75;
constexpr int hough_votes = 60;
constexpr double hough_least_length_px = 40;
constexpr double hough_largest_gap_px = 12;

}  // namespace

double length_px(const LineSegment& segment) {
  return std::hypot(segment.right.u_px - segment.left.u_px, segment.right.v_px - segment.left.v_px);
}

double inclination_deg(const LineSegment& segment) {
  return std::atan2(segment.right.v_px - segment.left.v_px, segment.right.u_px - segment.left.u_px) * 180.0 /
         std::numbers::pi;
}

std::vector<LineSegment> find_line_segments(const cv::Mat& bgr) {
  cv::Mat grey;
  cv::cvtColor(bgr, grey, cv::COLOR_BGR2GRAY);
  cv::erode(grey, grey, cv::Mat());
  cv::dilate(grey, grey, cv::Mat());
  cv::GaussianBlur(grey, grey, cv::Size(5, 5), 0);
  cv::Mat edges;
  cv::Canny(grey, edges, canny_low, canny_high, 3, true);
  std::vector<cv::Vec4i> found;
  cv::HoughLinesP(edges, found, 1.0, std::numbers::pi / 720, hough_votes, hough_least_length_px, hough_largest_gap_px);

  std::vector<LineSegment> segments;
  segments.reserve(found.size());
  for (const cv::Vec4i& ends : found) {
    const ImagePoint a{static_cast<double>(ends[0]), static_cast<double>(ends[1])};
    const ImagePoint b{static_cast<double>(ends[2]), static_cast<double>(ends[3])};
    segments.push_back(a.u_px <= b.u_px ? LineSegment{a, b} : LineSegment{b, a});
  }
  return segments;
}

}  // namespace telehug
