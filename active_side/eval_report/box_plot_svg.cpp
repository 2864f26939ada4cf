// SPDX-License-Identifier: Apache-2.0
#include "eval_report/box_plot_svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "eval/error_statistics.hpp"
#include "eval_report/linear_scale.hpp"
#include "eval_report/markup.hpp"

namespace telehug {
namespace {

constexpr double width_px = 560;
constexpr double row_px = 20;
constexpr double left_px = 170;
constexpr double right_px = width_px - 40;
constexpr double top_px = 28;
constexpr double half_box_px = 6;

using Output = std::back_insert_iterator<std::string>;

void draw_line(Output out, const char* kind, double x1, double y1, double x2, double y2) {
  fmt::format_to(out, "<line class=\"{}\" x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\"/>\n", kind, x1, y1,
                 x2, y2);
}

void draw_axis(Output out, const LinearScale& scale, double bottom_px) {
  for (const double tick : scale.ticks(6)) {
    const double x = scale.px(tick);
    draw_line(out, tick == 0 ? "axis" : "grid", x, top_px, x, bottom_px);
    fmt::format_to(out, "{}", svg_text(x, bottom_px + 14, "middle", "small", fmt::format("{:g}", tick)));
  }
}

void draw_box(Output out, const BoxPlot& box, const LinearScale& scale, double y) {
  const auto at = [&](double value) { return scale.clamped_px(value); };
  draw_line(out, "whisker", at(box.low_whisker), y, at(box.first_quartile), y);
  draw_line(out, "whisker", at(box.third_quartile), y, at(box.high_whisker), y);
  for (const double end : {box.low_whisker, box.high_whisker})
    draw_line(out, "whisker", at(end), y - half_box_px / 2, at(end), y + half_box_px / 2);
  fmt::format_to(out, "<rect class=\"box\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"/>\n",
                 at(box.first_quartile), y - half_box_px,
                 std::max(0.5, at(box.third_quartile) - at(box.first_quartile)), 2 * half_box_px);
  draw_line(out, "median", at(box.median), y - half_box_px, at(box.median), y + half_box_px);
}

// One circle for those in the same place; those beyond the axis are only counted.
void draw_outliers(Output out, const std::vector<double>& outliers, const LinearScale& scale, double y) {
  std::size_t below = 0;
  std::size_t above = 0;
  double drawn_px = 0;
  for (const double value : outliers) {
    if (scale.holds(value)) {
      const double x = std::round(scale.px(value));
      if (x != drawn_px) fmt::format_to(out, "<circle class=\"outlier\" cx=\"{:.0f}\" cy=\"{:.1f}\" r=\"2\"/>\n", x, y);
      drawn_px = x;
    } else {
      ++(value < 0 ? below : above);
    }
  }
  if (below > 0) fmt::format_to(out, "{}", svg_text(left_px - 3, y + 4, "end", "far", fmt::format("{} ◂", below)));
  if (above > 0) fmt::format_to(out, "{}", svg_text(right_px + 3, y + 4, "start", "far", fmt::format("▸ {}", above)));
}

}  // namespace

std::string box_plots_svg(const std::string& title, const std::vector<BoxPlotRow>& rows, double reach) {
  const double bottom_px = top_px + row_px * static_cast<double>(rows.size());
  const LinearScale scale(-reach, reach, left_px, right_px);
  std::string svg = svg_begin(width_px, bottom_px + 22, title);
  const auto out = std::back_inserter(svg);
  fmt::format_to(out, "{}", svg_text((left_px + right_px) / 2, 16, "middle", "title", title));
  draw_axis(out, scale, bottom_px);
  double y = top_px + row_px / 2;
  for (const BoxPlotRow& row : rows) {
    fmt::format_to(out, "{}",
                   svg_text(4, y + 4, "start", "label", fmt::format("{} ({})", row.name, row.values.size())));
    if (!row.values.empty()) {
      const BoxPlot box = box_plot(row.values);
      draw_box(out, box, scale, y);
      draw_outliers(out, box.outliers, scale, y);
    }
    y += row_px;
  }
  return svg + "</svg>\n";
}

}  // namespace telehug
