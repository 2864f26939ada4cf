// SPDX-License-Identifier: Apache-2.0
#include "eval_report/screen_svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "eval_report/linear_scale.hpp"
#include "eval_report/markup.hpp"

namespace telehug {
namespace {

constexpr std::size_t most_touches = 400;
constexpr double width_px = 760;
constexpr double margin_px = 44;
constexpr double usual_aspect = 0.6;  // height by width, of shares

using Output = std::back_insert_iterator<std::string>;

class ScreenDrawing {
 public:
  ScreenDrawing(const std::vector<ReportedTouch>& touches, bool one_screen)
      : touches_(touches),
        one_screen_(one_screen),
        screen_(one_screen ? touches.front().screen : ScreenSize{100, 100 * usual_aspect, 0, 0}),
        height_px_(2 * margin_px + (width_px - 2 * margin_px) * screen_.height_mm / screen_.width_mm),
        x_(0, one_screen ? screen_.width_mm : 100, margin_px, width_px - margin_px),
        y_(0, one_screen ? screen_.height_mm : 100, margin_px, height_px_ - margin_px) {}

  std::string draw() {
    const std::size_t every = (touches_.size() + most_touches - 1) / most_touches;
    const std::string title = every > 1 ? fmt::format("True and found points on the screen: 1 touch of {}", every)
                                        : std::string("True and found points on the screen");
    std::string svg = svg_begin(width_px, height_px_ + 26, title);
    const auto out = std::back_inserter(svg);
    fmt::format_to(out, "{}", svg_text(width_px / 2, 16, "middle", "title", title));
    fmt::format_to(out, "<rect class=\"screen\" x=\"{0}\" y=\"{0}\" width=\"{1:.1f}\" height=\"{2:.1f}\"/>\n",
                   margin_px, width_px - 2 * margin_px, height_px_ - 2 * margin_px);
    draw_axes(out);
    for (std::size_t i = 0; i < touches_.size(); i += every)
      draw_touch(out, touches_[i]);
    draw_legend(out);
    return svg + "</svg>\n";
  }

 private:
  void draw_axes(Output out) const {
    const char* unit = one_screen_ ? " mm" : " %";
    for (const double tick : x_.ticks(8)) {
      fmt::format_to(out, "{}",
                     svg_text(x_.px(tick), height_px_ - margin_px + 16, "middle", "small",
                              fmt::format("{:g}{}", tick, tick == 0 ? unit : "")));
    }
    for (const double tick : y_.ticks(5))
      fmt::format_to(out, "{}", svg_text(margin_px - 6, y_.px(tick) + 4, "end", "small", fmt::format("{:g}", tick)));
  }

  // A little beyond the screen's edge still shows where a point lies; farther off only that it does.
  ImagePoint drawn_at(const ScreenPoint& place, const ScreenSize& screen) const {
    const double x = one_screen_ ? place.x_mm : 100 * place.x_mm / screen.width_mm;
    const double y = one_screen_ ? place.y_mm : 100 * place.y_mm / screen.height_mm;
    constexpr double beside_px = 26;
    return {std::clamp(x_.px(x), margin_px - beside_px, width_px - margin_px + beside_px),
            std::clamp(y_.px(y), margin_px - beside_px, height_px_ - margin_px + beside_px)};
  }

  void draw_touch(Output out, const ReportedTouch& reported) const {
    const ScoredTouch& touch = reported.touch;
    const ImagePoint place = drawn_at(touch.place, reported.screen);
    if (!touch.found) {
      fmt::format_to(out, "<path class=\"missed\" d=\"M{:.1f} {:.1f}l8 8m0 -8l-8 8\"><title>{} missed</title></path>\n",
                     place.u_px - 4, place.v_px - 4, escaped(reported.frame));
      return;
    }
    const ImagePoint found = drawn_at(touch.found_place(), reported.screen);
    fmt::format_to(out,
                   "<g><title>{}: {:.1f} mm off</title><line class=\"error\" x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" "
                   "y2=\"{:.1f}\"/><circle class=\"true\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4\"/><circle class=\"found\" "
                   "cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2.2\"/></g>\n",
                   escaped(reported.frame), touch.error_mm(), place.u_px, place.v_px, found.u_px, found.v_px,
                   place.u_px, place.v_px, found.u_px, found.v_px);
  }

  void draw_legend(Output out) const {
    const double y = height_px_ + 12;
    fmt::format_to(out, "<circle class=\"true\" cx=\"{:.0f}\" cy=\"{:.1f}\" r=\"4\"/>{}", margin_px + 4, y - 4,
                   svg_text(margin_px + 14, y, "start", "label", "true"));
    fmt::format_to(out, "<circle class=\"found\" cx=\"{:.0f}\" cy=\"{:.1f}\" r=\"2.2\"/>{}", margin_px + 74, y - 4,
                   svg_text(margin_px + 84, y, "start", "label", "found"));
    fmt::format_to(out, "<path class=\"missed\" d=\"M{:.1f} {:.1f}l8 8m0 -8l-8 8\"/>{}", margin_px + 144, y - 8,
                   svg_text(margin_px + 160, y, "start", "label", "missed"));
  }

  const std::vector<ReportedTouch>& touches_;
  bool one_screen_;
  ScreenSize screen_;
  double height_px_;
  LinearScale x_;
  LinearScale y_;
};

}  // namespace

std::string screen_svg(const std::vector<ReportedTouch>& touches, bool one_screen) {
  return touches.empty() ? std::string() : ScreenDrawing(touches, one_screen).draw();
}

}  // namespace telehug
