// SPDX-License-Identifier: Apache-2.0
#include "jacket/body_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

namespace telehug {
namespace {

// One fh is 20 columns wide and 5 lines high: a character cell is about twice as high as wide, and the picture may be
// a little too wide, so that ids fit between the motors.
constexpr double columns_per_fh = 20;
constexpr double lines_per_fh = 5;
constexpr int midline_column = 29;
constexpr int chin_line = 3;

constexpr std::array<std::string_view, body_picture_lines> outline{
    R"(                        .---------.)",
    R"(                        |  o   o  |)",
    R"(                        |    v    |)",
    R"(                         '--___--')",
    R"(           ._____________|       |_____________.)",
    R"(      .--'                                      '--.)",
    R"(     /                                              \)",
    R"(    /                                                \)",
    R"(    |         |                            |         |)",
    R"(    |         |                            |         |)",
    R"(    |         |                            |         |)",
    R"(    |         |                            |         |)",
    R"(    |         |                            |         |)",
    R"(    |         |                            |         |)",
    R"(    '---------'____________________________'---------')",
};

using Line = std::array<std::string_view, body_picture_columns>;  // one character each, as UTF-8

Line blank_line(std::string_view drawn) {
  Line line;
  line.fill(" ");
  for (std::size_t column = 0; column < drawn.size(); ++column)
    line.at(column) = drawn.substr(column, 1);
  return line;
}

void draw(const Actuator& actuator, bool runs, std::array<Line, body_picture_lines>& picture) {
  const auto clamped = [](double at, int last) {
    return static_cast<int>(std::clamp(std::round(at), 0.0, last * 1.0));
  };
  static constexpr std::string_view digits = "0123456789";
  std::string_view label[4] = {runs ? "●" : "○"};
  std::size_t length = 1;
  for (int power = actuator.id >= 100 ? 100 : (actuator.id >= 10 ? 10 : 1); power > 0; power /= 10) {
    label[length++] = digits.substr(static_cast<std::size_t>(actuator.id / power % 10), 1);
  }
  const auto line =
      static_cast<std::size_t>(clamped(chin_line + actuator.place.y_fh * lines_per_fh, body_picture_lines - 1));
  const auto column = static_cast<std::size_t>(clamped(midline_column + actuator.place.x_fh * columns_per_fh - 1,
                                                       body_picture_columns - static_cast<int>(length)));
  std::copy_n(label, length, picture.at(line).begin() + static_cast<std::ptrdiff_t>(column));
}

}  // namespace

std::vector<std::string> body_picture(const JacketProfile& profile, std::span<const std::uint8_t> running,
                                      BodySide side) {
  std::array<Line, body_picture_lines> picture;
  std::ranges::transform(outline, picture.begin(), blank_line);
  for (const Actuator& actuator : profile.actuators) {
    if (actuator.side != side) continue;
    draw(actuator, std::ranges::find(running, actuator.id) != running.end(), picture);
  }
  std::vector<std::string> lines;
  for (const Line& line : picture) {
    std::string text;
    for (const std::string_view character : line)
      text += character;
    text.erase(text.find_last_not_of(' ') + 1);
    lines.push_back(std::move(text));
  }
  return lines;
}

}  // namespace telehug
