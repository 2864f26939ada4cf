// SPDX-License-Identifier: Apache-2.0
#include "setup/page_pictures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <opencv2/imgproc.hpp>

#include "calibration/calibration_page.hpp"

namespace telehug {
namespace {

constexpr double px_per_mm = 4;  // when the screen's pixels are not known

cv::Size picture_size(const ScreenSize& screen) {
  if (screen.width_px > 0 && screen.height_px > 0) return {screen.width_px, screen.height_px};
  return {static_cast<int>(std::lround(screen.width_mm * px_per_mm)),
          static_cast<int>(std::lround(screen.height_mm * px_per_mm))};
}

}  // namespace

cv::Mat triangle_picture(const ScreenSize& screen) {
  const cv::Size size = picture_size(screen);
  cv::Mat picture(size, CV_8UC3, cv::Scalar::all(255));
  std::array<cv::Point, calibration_triangle.size()> corners;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    corners[i] = {static_cast<int>(calibration_triangle[i].x * size.width),
                  std::min(static_cast<int>(calibration_triangle[i].y * size.height), size.height - 1)};
  }
  cv::fillConvexPoly(picture, corners.data(), static_cast<int>(corners.size()), cv::Scalar::all(0), cv::LINE_AA);
  return picture;
}

cv::Mat dots_picture(const ScreenSize& screen, const std::vector<ScreenPoint>& points) {
  constexpr int bits = 4;
  const cv::Size size = picture_size(screen);
  const auto fixed = [](double px) { return static_cast<int>(std::lround(px * (1 << bits))); };
  cv::Mat picture(size, CV_8UC3, cv::Scalar::all(0));
  for (const ScreenPoint& point : points) {
    // A pixel's centre has whole coordinates in OpenCV, so the screen's edge lies half a pixel before 0.
    const cv::Point centre(fixed(point.x_mm / screen.width_mm * size.width - 0.5),
                           fixed(point.y_mm / screen.height_mm * size.height - 0.5));
    const int radius = fixed(calibration_dot_mm / 2 / screen.width_mm * size.width);
    cv::circle(picture, centre, radius, cv::Scalar::all(255), cv::FILLED, cv::LINE_AA, bits);
  }
  return picture;
}

}  // namespace telehug
