// SPDX-License-Identifier: Apache-2.0
#include "finger/background_file.hpp"

#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "pictures/picture_file.hpp"

namespace telehug {
namespace {

constexpr const char* keyword = "telehug background";
constexpr int version = 1;
constexpr int most_rows_apart = 1;  // of the border that the file was made for, and of the calibration's

std::array<int, 4> corners(const BorderStrip::Layout& layout) {
  const auto last_rail = layout.first_row.end() - layout.columns;
  return {layout.first_row.front(), layout.first_row[static_cast<std::size_t>(layout.columns - 1)], *last_rail,
          layout.first_row.back()};
}

std::string note_text(const BorderStrip::Layout& layout) {
  const auto [near_left, near_right, far_left, far_right] = corners(layout);
  return fmt::format("{} {}x{} {} {} {} {}", version, layout.image.width_px, layout.image.height_px, near_left,
                     near_right, far_left, far_right);
}

bool agrees(const std::string& text, const BorderStrip::Layout& layout) {
  int written_version = 0;
  ImageSize image{};
  std::array<int, 4> rows{};
  const int read = std::sscanf(text.c_str(), "%d %dx%d %d %d %d %d", &written_version, &image.width_px,
                               &image.height_px, &rows[0], &rows[1], &rows[2], &rows[3]);
  if (read != 7 || written_version != version) return false;
  if (image.width_px != layout.image.width_px || image.height_px != layout.image.height_px) return false;
  const std::array<int, 4> wanted = corners(layout);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (std::abs(rows[i] - wanted[i]) > most_rows_apart) return false;
  }
  return true;
}

}  // namespace

std::filesystem::path background_file(const std::filesystem::path& calibration_file) {
  std::filesystem::path path = calibration_file;
  return path.replace_extension("background.png");
}

Status write_background(const std::filesystem::path& path, const cv::Mat& empty, const BorderStrip::Layout& layout) {
  if (empty.type() != CV_8UC3 || empty.cols != layout.image.width_px || empty.rows != layout.image.height_px) {
    return Error{"the picture of the empty rig has another size than those it was calibrated with"};
  }
  BorderStrip strip(layout);
  strip.sample(empty, layout);
  return write_png(path, strip.picture(), PngNote{keyword, note_text(layout)});
}

Result<BorderStrip> read_background(const std::filesystem::path& path, const BorderStrip::Layout& layout) {
  const auto note = read_png_note(path, keyword);
  if (!note) return note.error();
  if (!*note) return Error{fmt::format("{} holds no background of telehug's", path.string())};
  const auto picture = read_picture(path);
  if (!picture) return picture.error();
  if (!agrees(**note, layout) || picture->cols != layout.columns || picture->rows != BorderStrip::rails) {
    return Error{fmt::format("{} was made for another calibration, or by another version of telehug", path.string())};
  }
  BorderStrip strip(layout);
  strip.set(*picture);
  return strip;
}

}  // namespace telehug
