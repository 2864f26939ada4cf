// SPDX-License-Identifier: Apache-2.0
//
// Text inside a PNG file, as a tEXt chunk (PNG specification, 11.3.4.3), which libpng's simplified interface leaves
// out.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace telehug {

struct PngNote {
  std::string keyword;  // 1 to 79 characters of ASCII
  std::string text;     // ASCII, no zero
};

// Puts the note before the end of a PNG file's bytes, which must be complete.
void insert_png_note(std::vector<std::uint8_t>& png, const PngNote& note);

// The text of the first note of that keyword. Any bytes may be given.
[[nodiscard]] std::optional<std::string> find_png_note(std::span<const std::uint8_t> png, std::string_view keyword);

}  // namespace telehug
