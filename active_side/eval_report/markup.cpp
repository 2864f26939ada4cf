// SPDX-License-Identifier: Apache-2.0
#include "eval_report/markup.hpp"

#include <fmt/format.h>

namespace telehug {

std::string escaped(std::string_view text) {
  std::string safe;
  safe.reserve(text.size());
  for (const char c : text) {
    switch (c) {
      case '&':
        safe += "&amp;";
        break;
      case '<':
        safe += "&lt;";
        break;
      case '>':
        safe += "&gt;";
        break;
      case '"':
        safe += "&quot;";
        break;
      case '\'':
        safe += "&#39;";
        break;
      default: {
        const bool control = static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t';
        safe += control ? '?' : c;
      }
    }
  }
  return safe;
}

std::string jpeg_uri(std::span<const std::uint8_t> jpeg) {
  static constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string uri = "data:image/jpeg;base64,";
  uri.reserve(uri.size() + (jpeg.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < jpeg.size(); i += 3) {
    const std::size_t bytes = std::min<std::size_t>(3, jpeg.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8U | (k < bytes ? jpeg[i + k] : 0U);
    for (std::size_t k = 0; k < 4; ++k)
      uri += k <= bytes ? digits[group >> (18 - 6 * k) & 0x3FU] : '=';
  }
  return uri;
}

std::string svg_text(double x_px, double y_px, std::string_view anchor, std::string_view kind, std::string_view text) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\" class=\"{}\">{}</text>\n", x_px, y_px, anchor,
                     kind, escaped(text));
}

std::string svg_begin(double width_px, double height_px, std::string_view label) {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" style=\"max-width:{0:.0f}px\" "
      "role=\"img\" aria-label=\"{2}\">\n",
      width_px, height_px, escaped(label));
}

}  // namespace telehug
