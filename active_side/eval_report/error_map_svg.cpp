// SPDX-License-Identifier: Apache-2.0
#include "eval_report/error_map_svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "eval_report/markup.hpp"

namespace telehug {
namespace {

constexpr double cell_width_px = 44;
constexpr double cell_height_px = 34;
constexpr double top_px = 26;

std::size_t field(double share, std::size_t fields) {
  return static_cast<std::size_t>(
      std::clamp(std::floor(share * static_cast<double>(fields)), 0.0, static_cast<double>(fields - 1)));
}

// From pale yellow over orange to dark red: the darker the worse, also without colours.
std::string colour_of(double share) {
  static constexpr std::array<std::array<double, 3>, 4> stops{
      {{255, 247, 214}, {253, 190, 112}, {214, 84, 52}, {104, 18, 40}}};
  const double place = std::clamp(share, 0.0, 1.0) * (stops.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(place), stops.size() - 2);
  std::array<int, 3> rgb{};
  for (std::size_t i = 0; i < rgb.size(); ++i) {
    rgb[i] = static_cast<int>(
        std::lround(std::lerp(stops[below][i], stops[below + 1][i], place - static_cast<double>(below))));
  }
  return fmt::format("#{:02x}{:02x}{:02x}", rgb[0], rgb[1], rgb[2]);
}

const char* ink_on(double share) {
  return share > 0.55 ? "on-dark" : "on-pale";
}

std::string legend(double width_px, double y_px, double high, int decimals) {
  constexpr int steps = 20;
  const double step_px = (width_px - 120) / steps;
  std::string svg = svg_text(54, y_px + 10, "end", "small", "0");
  for (int i = 0; i < steps; ++i) {
    svg += fmt::format("<rect x=\"{:.2f}\" y=\"{:.1f}\" width=\"{:.2f}\" height=\"12\" fill=\"{}\"/>", 60 + i * step_px,
                       y_px, step_px + 0.3, colour_of((i + 0.5) / steps));
  }
  return svg + svg_text(width_px - 54, y_px + 10, "start", "small", fmt::format("{:.{}f}", high, decimals));
}

}  // namespace

ErrorMap map_errors(const std::vector<ReportedTouch>& touches,
                    const std::function<std::optional<double>(const ScoredTouch&)>& value) {
  ErrorMap map;
  for (const ReportedTouch& reported : touches) {
    const auto known = value(reported.touch);
    if (!known) continue;
    const ScreenPoint& place = reported.touch.place;
    const std::size_t column = field(place.x_mm / reported.screen.width_mm, ErrorMap::columns);
    const std::size_t row = field(place.y_mm / reported.screen.height_mm, ErrorMap::rows);
    MapCell& cell = map.cells[row * ErrorMap::columns + column];
    cell.value = cell.value.value_or(0) + *known;
    ++cell.touches;
  }
  for (MapCell& cell : map.cells) {
    if (cell.value) *cell.value /= static_cast<double>(cell.touches);
  }
  return map;
}

std::string error_map_svg(const std::string& title, const ErrorMap& map, double high, int decimals) {
  const double width_px = cell_width_px * ErrorMap::columns + 4;
  const double bottom_px = top_px + cell_height_px * ErrorMap::rows;
  std::string svg = svg_begin(width_px, bottom_px + 26, title);
  const auto out = std::back_inserter(svg);
  fmt::format_to(out, "{}", svg_text(width_px / 2, 16, "middle", "title", title));
  for (std::size_t i = 0; i < map.cells.size(); ++i) {
    const MapCell& cell = map.cells[i];
    const std::size_t row = i / ErrorMap::columns;
    const double x = 2 + cell_width_px * static_cast<double>(i - row * ErrorMap::columns);
    const double y = top_px + cell_height_px * static_cast<double>(row);
    const double share = cell.value.value_or(0) / high;
    fmt::format_to(out, "<rect class=\"cell\" x=\"{:.0f}\" y=\"{:.0f}\" width=\"{:.0f}\" height=\"{:.0f}\"{}/>\n", x, y,
                   cell_width_px, cell_height_px,
                   cell.value ? fmt::format(" style=\"fill:{}\"", colour_of(share)) : std::string());
    if (!cell.value) continue;
    const double middle = x + cell_width_px / 2;
    fmt::format_to(
        out, "{}{}",
        svg_text(middle, y + 16, "middle", fmt::format("label {}", ink_on(share)),
                 fmt::format("{:.{}f}", *cell.value, decimals)),
        svg_text(middle, y + 28, "middle", fmt::format("tiny {}", ink_on(share)), fmt::format("{}", cell.touches)));
  }
  return svg + legend(width_px, bottom_px + 8, high, decimals) + "</svg>\n";
}

}  // namespace telehug
