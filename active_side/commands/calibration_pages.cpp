// SPDX-License-Identifier: Apache-2.0
#include "commands/calibration_pages.hpp"

#include <fmt/core.h>

#include <filesystem>

#include "calibration/calibration_page.hpp"
#include "pictures/picture_file.hpp"
#include "setup/page_pictures.hpp"

namespace telehug {
namespace {

constexpr const char* folder = "telehug-calibration";
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
