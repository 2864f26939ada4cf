// SPDX-License-Identifier: Apache-2.0
#include "eval_report/failure_svg.hpp"

#include <fmt/format.h>

#include <array>

#include "eval_report/markup.hpp"

namespace telehug {
namespace {

// Rings, with a dark one around for pale pictures; sizes in thousandths of the picture's width, which varies.
std::string mark(const char* kind, const ImagePoint& at, double width_px) {
  const double unit = width_px / 1000;
  return fmt::format(
      "<circle class=\"mark-edge\" cx=\"{0:.1f}\" cy=\"{1:.1f}\" r=\"{2:.1f}\" stroke-width=\"{3:.1f}\"/>"
      "<circle class=\"{5}\" cx=\"{0:.1f}\" cy=\"{1:.1f}\" r=\"{2:.1f}\" stroke-width=\"{4:.1f}\"/>\n",
      at.u_px, at.v_px, 22 * unit, 14 * unit, 7 * unit, kind);
}

const char* name_of(FailureKind kind) {
  static constexpr std::array<const char*, 3> names{"missed", "far off", "false touch"};
  return names.at(static_cast<std::size_t>(kind));
}

}  // namespace

std::string failure_figure(const FailurePicture& picture) {
  const Failure& failure = picture.failure;
  std::string svg = svg_begin(picture.size.width_px, picture.size.height_px, failure.frame + ": " + failure.what);
  svg += fmt::format("<image width=\"{}\" height=\"{}\" href=\"{}\"/>\n", picture.size.width_px, picture.size.height_px,
                     jpeg_uri(picture.jpeg));
  const double width_px = picture.size.width_px;
  if (picture.place_px && picture.found_px) {
    svg += fmt::format(
        "<line class=\"mark-line\" x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" "
        "stroke-width=\"{:.1f}\"/>\n",
        picture.place_px->u_px, picture.place_px->v_px, picture.found_px->u_px, picture.found_px->v_px, width_px / 250);
  }
  if (picture.place_px) svg += mark("mark-true", *picture.place_px, width_px);
  if (picture.found_px) svg += mark("mark-found", *picture.found_px, width_px);
  return fmt::format("<figure>{}</svg><figcaption><b>{}</b> {}<br>{}</figcaption></figure>\n", svg,
                     name_of(failure.kind), escaped(failure.frame), escaped(failure.what));
}

}  // namespace telehug
