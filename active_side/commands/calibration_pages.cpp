// SPDX-License-Identifier: Apache-2.0
#include "commands/calibration_pages.hpp"

#include <fmt/core.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <opencv2/imgproc.hpp>

#include "calibration/calibration_page.hpp"
#include "pictures/picture_file.hpp"

namespace telehug {
namespace {

constexpr const char* folder = "telehug-calibration";
constexpr double px_per_mm = 4;  // when the screen's pixels are not known

cv::Size picture_size(const ScreenSize& screen) {
  if (screen.width_px > 0 && screen.height_px > 0) return {screen.width_px, screen.height_px};
  return {static_cast<int>(std::lround(screen.width_mm * px_per_mm)),
          static_cast<int>(std::lround(screen.height_mm * px_per_mm))};
}

// Black on white, one vertex in the middle of the bottom edge: it tells the screen's own edge from the bezel's others.
cv::Mat triangle_picture(const ScreenSize& screen) {
  const cv::Size size = picture_size(screen);
  cv::Mat picture(size, CV_8UC3, cv::Scalar::all(255));
  const std::array corners{cv::Point(size.width / 2, size.height - 1), cv::Point(size.width / 4, size.height / 3),
                           cv::Point(3 * size.width / 4, size.height / 3)};
  cv::fillConvexPoly(picture, corners.data(), static_cast<int>(corners.size()), cv::Scalar::all(0), cv::LINE_AA);
  return picture;
}

// Exact to a sixteenth of a pixel: the camera sees where marks are to less than half of one.
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

}  // namespace

std::string CalibrationPages::triangle() {
  return fmt::format("{}/01-triangle.png", folder);
}

std::string CalibrationPages::black() {
  return fmt::format("{}/02-black.png", folder);
}

std::string CalibrationPages::marks() {
  return fmt::format("{}/03-marks.png", folder);
}

std::string CalibrationPages::dot(std::size_t touch) const {
  return fmt::format("{}/{:02}-dot-{}.png", folder, touch + (with_marks ? 4 : 3), touch + 1);
}

Status CalibrationPages::write(const ScreenSize& screen, const std::vector<ScreenPoint>& points) const {
  std::error_code code;
  std::filesystem::create_directories(folder, code);
  if (code) return Error{fmt::format("can't make the folder {}: {}", folder, code.message())};
  if (Status written = write_png(triangle(), triangle_picture(screen)); !written) return written;
  if (Status written = write_png(black(), dots_picture(screen, {})); !written) return written;
  if (with_marks) {
    if (Status written = write_png(marks(), dots_picture(screen, mark_points(screen))); !written) return written;
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (Status written = write_png(dot(i), dots_picture(screen, {points[i]})); !written) return written;
  }
  return Done{};
}

}  // namespace telehug
