// SPDX-License-Identifier: Apache-2.0
#include "pairing_link/qr_code.hpp"

#include <fmt/core.h>
#include <qrencode.h>

#include <memory>
#include <stdexcept>

namespace telehug {

namespace {

// 15 % of the code may be hidden or misread, by a reflection on a screen for example.
constexpr QRecLevel correction = QR_ECLEVEL_M;

// Of the whole code with its margin; row and column begin at the margin's outer edge.
bool is_dark_in_margin(const QrCode& code, std::size_t row, std::size_t column) {
  const bool inside =
      row >= qr_margin && column >= qr_margin && row < code.side + qr_margin && column < code.side + qr_margin;
  return inside && code.is_dark(row - qr_margin, column - qr_margin);
}

}  // namespace

QrCode make_qr_code(const std::string& text) {
  constexpr int smallest_that_fits = 0;
  constexpr int as_written = 1;
  const std::unique_ptr<QRcode, void (*)(QRcode*)> made(
      QRcode_encodeString(text.c_str(), smallest_that_fits, correction, QR_MODE_8, as_written), QRcode_free);
  if (!made) throw std::runtime_error("this text is empty or too long for a QR code");
  QrCode code{static_cast<std::size_t>(made->width), {}};
  code.dark.reserve(code.side * code.side);
  for (std::size_t i = 0; i < code.side * code.side; ++i)
    code.dark.push_back((made->data[i] & 1U) != 0);
  return code;
}

std::string to_terminal(const QrCode& code) {
  // Black and white of the 256 colours; themes redefine only the first 16.
  constexpr const char* black_on_white = "\x1b[38;5;16;48;5;231m";
  constexpr const char* as_before = "\x1b[0m";
  const std::size_t side = code.side + 2 * qr_margin;
  std::string text;
  for (std::size_t row = 0; row < side; row += 2) {
    text += black_on_white;
    for (std::size_t column = 0; column < side; ++column) {
      const bool upper = is_dark_in_margin(code, row, column);
      const bool lower = is_dark_in_margin(code, row + 1, column);
      text += upper ? (lower ? "█" : "▀") : (lower ? "▄" : " ");
    }
    text += as_before;
    text += '\n';
  }
  return text;
}

std::string to_svg(const QrCode& code) {
  std::string path;
  for (std::size_t row = 0; row < code.side; ++row) {
    for (std::size_t column = 0; column < code.side; ++column) {
      const std::size_t from = column;
      while (column < code.side && code.is_dark(row, column))
        ++column;
      if (column > from)
        path += fmt::format("M{} {}h{}v1H{}z", from + qr_margin, row + qr_margin, column - from, from + qr_margin);
    }
  }
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {0}\" shape-rendering=\"crispEdges\">"
      "<path fill=\"#fff\" d=\"M0 0h{0}v{0}H0z\"/><path d=\"{1}\"/></svg>\n",
      code.side + 2 * qr_margin, path);
}

}  // namespace telehug
