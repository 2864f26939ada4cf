// SPDX-License-Identifier: Apache-2.0
#include "pictures/png_note.hpp"

#include <array>
#include <boost/crc.hpp>
#include <boost/endian/conversion.hpp>
#include <cstddef>

namespace telehug {
namespace {

// A chunk: the length of its data, its type, its data, the CRC-32 of both.
constexpr std::size_t signature_bytes = 8;
constexpr std::size_t length_bytes = 4;
constexpr std::size_t type_bytes = 4;
constexpr std::size_t crc_bytes = 4;
constexpr std::size_t frame_bytes = length_bytes + type_bytes + crc_bytes;
constexpr std::string_view text_type = "tEXt";

void append(std::vector<std::uint8_t>& bytes, std::uint32_t number) {
  std::array<std::uint8_t, 4> big_endian{};
  boost::endian::store_big_u32(big_endian.data(), number);
  bytes.insert(bytes.end(), big_endian.begin(), big_endian.end());
}

}  // namespace

void insert_png_note(std::vector<std::uint8_t>& png, const PngNote& note) {
  const std::string content = std::string(text_type) + note.keyword + '\0' + note.text;
  boost::crc_32_type crc;
  crc.process_bytes(content.data(), content.size());
  std::vector<std::uint8_t> chunk;
  append(chunk, static_cast<std::uint32_t>(content.size() - type_bytes));
  chunk.insert(chunk.end(), content.begin(), content.end());
  append(chunk, crc.checksum());
  png.insert(png.end() - frame_bytes, chunk.begin(), chunk.end());  // the last chunk, IEND, is empty
}

std::optional<std::string> find_png_note(std::span<const std::uint8_t> png, std::string_view keyword) {
  std::size_t at = signature_bytes;
  while (at + frame_bytes <= png.size()) {
    const std::size_t length = boost::endian::load_big_u32(png.data() + at);
    if (length > png.size() - at - frame_bytes) return std::nullopt;
    const auto* const content = reinterpret_cast<const char*>(png.data() + at + length_bytes);
    const std::string_view type(content, type_bytes);
    const std::string_view data(content + type_bytes, length);
    const std::size_t end = data.find('\0');
    if (type == text_type && end != std::string_view::npos && data.substr(0, end) == keyword) {
      return std::string(data.substr(end + 1));
    }
    at += frame_bytes + length;
  }
  return std::nullopt;
}

}  // namespace telehug
