// SPDX-License-Identifier: Apache-2.0
#include "jacket/body_svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace telehug {
namespace {

constexpr double px_per_fh = 140;
constexpr double width_px = 3.2 * px_per_fh;  // of one body
constexpr double chin_px = 1.25 * px_per_fh;
constexpr double height_px = chin_px + 2.5 * px_per_fh;
constexpr double title_px = 30;
constexpr double grid_width_px = standard_columns * standard_box_side_fh * px_per_fh;

std::string escaped(std::string_view text) {
  std::string all;
  for (const char c : text) {
    switch (c) {
      case '&':
        all += "&amp;";
        break;
      case '<':
        all += "&lt;";
        break;
      case '>':
        all += "&gt;";
        break;
      case '"':
        all += "&quot;";
        break;
      default:
        // XML knows no other control characters.
        all += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
  }
  return all;
}

// Head, trunk and arms of a child, in face heights from the chin.
std::string outline() {
  const auto x = [](double fh) { return width_px / 2 + fh * px_per_fh; };
  const auto y = [](double fh) { return chin_px + fh * px_per_fh; };
  return fmt::format(
      "<ellipse cx='{}' cy='{}' rx='{}' ry='{}'/>\n"
      "<path d='M{} {} L{} {} Q{} {} {} {} L{} {} L{} {} Q{} {} {} {} L{} {}'/>\n"
      "<path d='M{} {} L{} {} M{} {} L{} {}'/>\n",
      x(0), y(-0.5), 0.38 * px_per_fh, 0.52 * px_per_fh,                                   // head
      x(-0.25), y(0.1), x(-0.8), y(0.2), x(-1.25), y(0.25), x(-1.3), y(2.2),               // right shoulder and arm
      x(-0.8), y(2.2), x(1.3), y(2.2), x(1.25), y(0.25), x(0.8), y(0.2), x(0.25), y(0.1),  // left ones
      x(-0.75), y(0.8), x(-0.75), y(2.2), x(0.75), y(0.8), x(0.75), y(2.2));               // between arms and trunk
}

std::string drawn(const Actuator& actuator, bool runs) {
  const double x = width_px / 2 + actuator.place.x_fh * px_per_fh;
  const double y = chin_px + actuator.place.y_fh * px_per_fh;
  const std::string_view style = !actuator.enabled ? "off" : runs ? "runs" : "rests";
  std::string shape =
      actuator.kind == ActuatorKind::heater
          ? fmt::format("<rect class='{}' x='{}' y='{}' width='28' height='28'/>", style, x - 14, y - 14)
          : fmt::format("<circle class='{}' cx='{}' cy='{}' r='14'/>", style, x, y);
  if (!actuator.enabled) shape += fmt::format("<path d='M{} {} l20 20 m0 -20 l-20 20'/>", x - 10, y - 10);
  return fmt::format(
      "<g data-actuator='{4}'><title>{0}</title>{1}<text x='{2}' y='{3}'>{4}</text><text class='name' x='{2}' "
      "y='{5}'>{0}</text></g>\n",
      escaped(actuator.name), shape, x, y + 5, actuator.id, y + 26);
}

}  // namespace

std::string body_svg(const JacketProfile& profile, std::span<const std::uint8_t> running) {
  std::string svg = fmt::format(
      "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 {} {}' role='img' aria-label='{}'>\n"
      "<style>text{{font:14px sans-serif;text-anchor:middle}}.name{{font-size:9px}}"
      "ellipse,path{{fill:none;stroke:#777;stroke-width:2}}.rests{{fill:#fff;stroke:#06c;stroke-width:2}}"
      ".runs{{fill:#fb0;stroke:#06c;stroke-width:3}}.off{{fill:#eee;stroke:#999;stroke-width:2}}</style>\n",
      2 * width_px, title_px + height_px, escaped(profile.name));
  for (const BodySide side : {BodySide::front, BodySide::back}) {
    const double left_px = side == BodySide::front ? 0 : width_px;
    const std::string_view name = side == BodySide::front ? "front" : "back";
    svg += fmt::format(
        "<g data-side='{0}' data-grid='{1} {2} {3} {4}' transform='translate({5} {6})'>\n"
        "<text class='caption' x='{7}' y='-8'>{8}: {0}</text>\n{9}",
        name, left_px + width_px / 2 - grid_width_px / 2, title_px + chin_px, grid_width_px, height_px - chin_px,
        left_px, title_px, width_px / 2, escaped(profile.name), outline());
    for (const Actuator& actuator : profile.actuators) {
      if (actuator.side != side) continue;
      svg += drawn(actuator, std::ranges::find(running, actuator.id) != running.end());
    }
    svg += "</g>\n";
  }
  return svg + "</svg>\n";
}

}  // namespace telehug
