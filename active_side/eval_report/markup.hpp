// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace telehug {

// Text as it may stand between tags and within quoted attributes of HTML and SVG. Characters that XML can't hold
// become a question mark.
[[nodiscard]] std::string escaped(std::string_view text);

// "data:image/jpeg;base64,..."
[[nodiscard]] std::string jpeg_uri(std::span<const std::uint8_t> jpeg);

// A text of SVG. `anchor`: start, middle or end; `kind`: a class of the page's style.
[[nodiscard]] std::string svg_text(double x_px, double y_px, std::string_view anchor, std::string_view kind,
                                   std::string_view text);

// Opens an <svg> of this size, as wide as there is room for; `label` says in words what it shows.
[[nodiscard]] std::string svg_begin(double width_px, double height_px, std::string_view label);

}  // namespace telehug
