// SPDX-License-Identifier: Apache-2.0
//
// What is drawn is read by a decoder that others wrote (ZXing).
#define ZX_USE_UTF8 1  // texts as std::string
#include "pairing_link/qr_code.hpp"

#include <ZXing/ReadBarcode.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "pairing_link/pairing_code.hpp"

namespace telehug {
namespace {

constexpr std::size_t pixels_a_module = 4;

struct Picture {
  std::size_t width;
  std::vector<unsigned char> grey;
};

// Rows of modules; true: dark.
Picture picture(const std::vector<std::vector<bool>>& rows) {
  Picture drawn{rows.at(0).size() * pixels_a_module, {}};
  for (std::size_t y = 0; y < rows.size() * pixels_a_module; ++y) {
    for (std::size_t x = 0; x < drawn.width; ++x)
      drawn.grey.push_back(rows[y / pixels_a_module].at(x / pixels_a_module) ? 0 : 255);
  }
  return drawn;
}

std::string decoded(const Picture& drawn) {
  const ZXing::ImageView view(drawn.grey.data(), static_cast<int>(drawn.width),
                              static_cast<int>(drawn.grey.size() / drawn.width), ZXing::ImageFormat::Lum);
  return ZXing::ReadBarcode(view, ZXing::DecodeHints().setFormats(ZXing::BarcodeFormat::QRCode)).text();
}

std::vector<std::vector<bool>> empty_rows(const QrCode& code) {
  const std::size_t side = code.side + 2 * qr_margin;
  return std::vector(side, std::vector<bool>(side));
}

Picture picture_of(const QrCode& code) {
  auto rows = empty_rows(code);
  for (std::size_t row = 0; row < code.side; ++row) {
    for (std::size_t column = 0; column < code.side; ++column)
      rows[row + qr_margin][column + qr_margin] = code.is_dark(row, column);
  }
  return picture(rows);
}

// As a terminal shows it: each character is two modules, one above the other.
Picture picture_on_terminal(std::string_view text) {
  std::vector<std::vector<bool>> rows;
  while (!text.empty()) {
    std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(line.size() + 1);
    std::vector<bool> upper;
    std::vector<bool> lower;
    while (!line.empty()) {
      if (line.front() == '\x1b') {
        line.remove_prefix(line.find('m') + 1);
        continue;
      }
      const std::string_view block = line.substr(0, line.front() == ' ' ? 1 : 3);
      line.remove_prefix(block.size());
      upper.push_back(block == "█" || block == "▀");
      lower.push_back(block == "█" || block == "▄");
    }
    rows.push_back(upper);
    rows.push_back(lower);
  }
  return picture(rows);
}

// The paths of to_svg(): "M4 4h7v1H4z", once per run of dark modules.
Picture picture_of_svg(const QrCode& code, const std::string& svg) {
  auto rows = empty_rows(code);
  const std::size_t path = svg.find("<path d=\"");
  for (std::size_t at = svg.find('M', path); at != std::string::npos; at = svg.find('M', at + 1)) {
    std::size_t x = 0;
    std::size_t y = 0;
    std::size_t length = 0;
    EXPECT_EQ(std::sscanf(svg.c_str() + at, "M%zu %zuh%zuv1H", &x, &y, &length), 3);
    for (std::size_t i = 0; i < length; ++i)
      rows.at(y).at(x + i) = true;
  }
  return picture(rows);
}

TEST(AQrCode, OfEveryPairingCodeIsReadByACamera) {
  for (int i = 0; i < 50; ++i) {
    const std::string text = to_qr_text(make_pairing_code({{192, 168, 1, 20}, 4711}));
    const QrCode code = make_qr_code(text);
    EXPECT_EQ(terminal_columns(code), 37U);
    EXPECT_EQ(decoded(picture_of(code)), text);
  }
}

TEST(AQrCode, IsReadFromTheTerminalAndFromItsSvg) {
  const std::string text = to_qr_text(make_pairing_code({{10, 77, 0, 1}, 65535}));
  const QrCode code = make_qr_code(text);
  EXPECT_EQ(decoded(picture_on_terminal(to_terminal(code))), text);
  EXPECT_EQ(decoded(picture_of_svg(code, to_svg(code))), text);
}

TEST(AQrCode, HoldsNoMoreThanAQrCodeCan) {
  EXPECT_THROW((void)make_qr_code(""), std::runtime_error);
  EXPECT_THROW((void)make_qr_code(std::string(10'000, 'A')), std::runtime_error);
  EXPECT_EQ(decoded(picture_of(make_qr_code("Grüße"))), "Grüße");
}

}  // namespace
}  // namespace telehug
