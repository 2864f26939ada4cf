// SPDX-License-Identifier: Apache-2.0
//
// Texts as QR codes, for a camera to read.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace telehug {

// A light margin of this many modules belongs to every code; the writers below add it.
inline constexpr std::size_t qr_margin = 4;

struct QrCode {
  std::size_t side = 0;    // modules
  std::vector<bool> dark;  // side * side, row by row

  [[nodiscard]] bool is_dark(std::size_t row, std::size_t column) const { return dark[row * side + column]; }
};

// Throws std::runtime_error (a sentence) if the text is too long for one.
[[nodiscard]] QrCode make_qr_code(const std::string& text);

// Columns of a terminal that to_terminal() needs.
[[nodiscard]] constexpr std::size_t terminal_columns(const QrCode& code) {
  return code.side + 2 * qr_margin;
}

// Two rows of modules a line, in black on white whatever the terminal's colours are.
[[nodiscard]] std::string to_terminal(const QrCode& code);

// A whole SVG document; it scales to whatever holds it.
[[nodiscard]] std::string to_svg(const QrCode& code);

}  // namespace telehug
