// SPDX-License-Identifier: Apache-2.0
#include "bench/rendering/accuracy_picture.hpp"

#include <fmt/format.h>

#include <iterator>

namespace telehug {
namespace {

constexpr double px_per_fh = 240;
constexpr double margin_px = 60;
constexpr double left_fh = -standard_columns * standard_box_side_fh / 2;
constexpr int rows = 4;
constexpr double width_px = standard_columns * standard_box_side_fh * px_per_fh + 2 * margin_px;
constexpr double height_px = rows * standard_box_side_fh * px_per_fh + 2 * margin_px;

double x_px(double x_fh) {
  return margin_px + (x_fh - left_fh) * px_per_fh;
}
double y_px(double y_fh) {
  return margin_px + y_fh * px_per_fh;
}

std::string escaped(const std::string& text) {
  std::string made;
  for (const char character : text) {
    switch (character) {
      case '&':
        made += "&amp;";
        break;
      case '<':
        made += "&lt;";
        break;
      default:
        made += character;
    }
  }
  return made;
}

}  // namespace

std::string accuracy_picture(const JacketProfile& profile, const std::vector<FeltPlace>& places,
                             const std::string& title, const std::string& figures) {
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" font-family=\"sans-serif\">\n"
      "<!-- SPDX-License-Identifier: Apache-2.0 -->\n"
      "<style>.box{{fill:none;stroke:#ddd}} .touch{{fill:#888}} .felt{{fill:#c2185b}} .way{{stroke:#c2185b}}"
      " .nowhere{{stroke:#888;fill:none}} .motor{{fill:#fff;stroke:#1565c0;stroke-width:3}}"
      " text{{text-anchor:middle;fill:#222}}</style>\n"
      "<rect width=\"{0:.0f}\" height=\"{1:.0f}\" fill=\"#fff\"/>\n"
      "<text x=\"{2:.0f}\" y=\"26\" font-size=\"18\">{3}</text>\n"
      "<text x=\"{2:.0f}\" y=\"46\" font-size=\"13\">{5}</text>\n"
      "<text x=\"{2:.0f}\" y=\"{4:.0f}\" font-size=\"13\">grey: touch; red: where it is felt; empty: "
      "nowhere; blue: motors; a box is half a face height wide</text>\n",
      width_px, height_px, width_px / 2, escaped(title), height_px - 20, escaped(figures));
  const auto out = std::back_inserter(svg);
  for (int box = 0; box < standard_columns * rows; ++box) {
    fmt::format_to(out, "<rect class=\"box\" x=\"{0:.1f}\" y=\"{1:.1f}\" width=\"{2:.1f}\" height=\"{2:.1f}\"/>\n",
                   x_px(left_fh + box % standard_columns * standard_box_side_fh),
                   y_px(box / standard_columns * standard_box_side_fh), standard_box_side_fh * px_per_fh);
  }
  for (const Actuator& actuator : profile.actuators) {
    if (actuator.side != BodySide::front || actuator.kind != ActuatorKind::motor) continue;
    const double x = x_px(actuator.place.x_fh);
    const double y = y_px(actuator.place.y_fh);
    fmt::format_to(out,
                   "<circle class=\"motor\" cx=\"{0:.1f}\" cy=\"{1:.1f}\" r=\"13\"/>"
                   "<text x=\"{0:.1f}\" y=\"{2:.1f}\" font-size=\"13\">{3}</text>\n",
                   x, y, y + 4.5, actuator.id);
  }
  for (const FeltPlace& place : places) {
    const double x = x_px(place.touch.x_fh);
    const double y = y_px(place.touch.y_fh);
    if (!place.felt) {
      fmt::format_to(out, "<circle class=\"nowhere\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3\"/>\n", x, y);
      continue;
    }
    const double felt_x = x_px(place.felt->x_fh);
    const double felt_y = y_px(place.felt->y_fh);
    fmt::format_to(out,
                   "<circle class=\"touch\" cx=\"{0:.1f}\" cy=\"{1:.1f}\" r=\"3\"/>"
                   "<line class=\"way\" x1=\"{0:.1f}\" y1=\"{1:.1f}\" x2=\"{2:.1f}\" y2=\"{3:.1f}\"/>"
                   "<circle class=\"felt\" cx=\"{2:.1f}\" cy=\"{3:.1f}\" r=\"1.8\"/>\n",
                   x, y, felt_x, felt_y);
  }
  svg += "</svg>\n";
  return svg;
}

}  // namespace telehug
