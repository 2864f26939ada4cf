// SPDX-License-Identifier: Apache-2.0
//
// Pictures of a camera (MJPEG) and picture files. Where a whole JPEG is read, any rows of it are the same to the bit.
#include <cstdlib>
#include <opencv2/core.hpp>
#include <optional>

#include "doubles/temporary_folder.hpp"
#include "fuzz/bytes.hpp"
#include "pictures/picture_file.hpp"

namespace telehug {
namespace {

constexpr unsigned most_pixels = 1 << 18;  // more takes time and finds nothing else

void require(bool holds) {
  if (!holds) std::abort();
}

unsigned big_endian(std::string_view bytes, std::size_t at, std::size_t count) {
  unsigned value = 0;
  for (std::size_t i = 0; i < count && at + i < bytes.size(); ++i)
    value = value << 8U | static_cast<unsigned char>(bytes[at + i]);
  return value & 0xFFFFU;
}

// Does any frame header, wherever one may be seen in these bytes, announce a big picture?
bool big(std::string_view bytes) {
  for (std::size_t at = 0; at + 9 < bytes.size(); ++at) {
    const bool frame = bytes[at] == '\xFF' && (static_cast<unsigned char>(bytes[at + 1]) & 0xF0U) == 0xC0U;
    if (frame && big_endian(bytes, at + 5, 2) * big_endian(bytes, at + 7, 2) > most_pixels) return true;
    const bool header = bytes.substr(at, 4) == "IHDR";
    if (header && big_endian(bytes, at + 6, 2) * big_endian(bytes, at + 10, 2) > most_pixels) return true;
  }
  return false;
}

void decode(std::string_view bytes, RowRange rows) {
  const std::span jpeg(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
  cv::Mat whole;
  const bool read = JpegDecoder().decode(jpeg, whole).ok();
  cv::Mat part;
  const bool read_part = JpegDecoder().decode(jpeg, part, rows).ok();
  if (!read) return;
  require(read_part && part.size() == whole.size());
  rows = rows.within(whole.rows);
  if (rows.count() == 0) return;
  require(cv::norm(part.rowRange(rows.first, rows.end), whole.rowRange(rows.first, rows.end), cv::NORM_INF) == 0);
}

void read_file(const std::string& bytes) {
  static const TemporaryFolder folder;
  const auto file = folder.write("picture", bytes);
  const auto picture = read_picture(file);
  require(picture ? !picture->empty() && picture->type() == CV_8UC3 : !picture.error().message.empty());
  (void)read_png_note(file, "telehug background");
  if (!picture) return;
  require(write_png(folder / "again", *picture).ok());
  require(cv::norm(read_picture(folder / "again").value(), *picture, cv::NORM_INF) == 0);
}

}  // namespace
}  // namespace telehug

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace telehug;
  Bytes bytes(data, size);
  const std::uint8_t how = bytes.byte();
  const RowRange rows{bytes.byte(), bytes.byte()};
  const std::string picture = bytes.rest();
  if (big(picture)) return 0;
  if (how % 2 == 0) {
    decode(picture, rows);
  } else {
    read_file(picture);
  }
  return 0;
}
