// SPDX-License-Identifier: Apache-2.0
#include "pictures/picture_file.hpp"

#include <fmt/format.h>
#include <png.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <memory>
#include <span>
#include <vector>

#include "pictures/jpeg_encoder.hpp"

namespace telehug {
namespace {

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

constexpr std::uintmax_t max_file_bytes = 64u << 20;
constexpr png_uint_32 max_side_px = 8192;

Error system_error(const char* doing, const std::filesystem::path& path, int code) {
  return Error{fmt::format("can't {} {}: {}", doing, path.string(), std::strerror(code))};
}

Status read_bytes(const std::filesystem::path& path, std::vector<std::uint8_t>& bytes) {
  std::error_code code;
  if (!std::filesystem::exists(path, code)) return system_error("read", path, ENOENT);
  if (!std::filesystem::is_regular_file(path, code)) return Error{fmt::format("{} is not a file", path.string())};
  const auto size = std::filesystem::file_size(path, code);
  if (code) return system_error("read", path, code.value());
  if (size > max_file_bytes) {
    return Error{fmt::format("{} has {} bytes; pictures of at most {} are read", path.string(), size, max_file_bytes)};
  }
  const File file{std::fopen(path.c_str(), "rb"), &std::fclose};
  if (!file) return system_error("read", path, errno);
  bytes.resize(size);
  if (std::fread(bytes.data(), 1, bytes.size(), file.get()) != bytes.size()) return system_error("read", path, EIO);
  return Done{};
}

// png_image owns memory until its reading or writing ends.
struct PngImage {
  png_image image{};
  PngImage() { image.version = PNG_IMAGE_VERSION; }
  ~PngImage() { png_image_free(&image); }
  PngImage(const PngImage&) = delete;
  PngImage& operator=(const PngImage&) = delete;
};

Status decode_png(std::span<const std::uint8_t> bytes, cv::Mat& bgr) {
  PngImage png;
  if (png_image_begin_read_from_memory(&png.image, bytes.data(), bytes.size()) == 0) {
    return Error{fmt::format("damaged PNG picture: {}", png.image.message)};
  }
  if (png.image.width > max_side_px || png.image.height > max_side_px) {
    return Error{fmt::format("PNG picture of {}x{} pixels; at most {} a side are read", png.image.width,
                             png.image.height, max_side_px)};
  }
  png.image.format = PNG_FORMAT_BGR;
  bgr.create(static_cast<int>(png.image.height), static_cast<int>(png.image.width), CV_8UC3);
  const png_color black{0, 0, 0};
  if (png_image_finish_read(&png.image, &black, bgr.data, static_cast<png_int_32>(bgr.step), nullptr) == 0) {
    return Error{fmt::format("damaged PNG picture: {}", png.image.message)};
  }
  return Done{};
}

// Writes a file of another name and gives it its name when all went well.
Status write_file(const std::filesystem::path& path, std::span<const std::uint8_t> bytes) {
  const std::filesystem::path unfinished = path.string() + fmt::format(".{}.part", ::getpid());
  File file{std::fopen(unfinished.c_str(), "wb"), &std::fclose};
  if (!file) return system_error("write", path, errno);
  Status written = Done{};
  if (std::fwrite(bytes.data(), 1, bytes.size(), file.get()) != bytes.size()) written = Error{std::strerror(errno)};
  if (std::fclose(file.release()) != 0 && written) written = Error{std::strerror(errno)};
  std::error_code code;
  if (written) std::filesystem::rename(unfinished, path, code);
  if (written && !code) return Done{};
  std::error_code ignored;
  std::filesystem::remove(unfinished, ignored);
  return Error{fmt::format("can't write {}: {}", path.string(), code ? code.message() : written.error().message)};
}

}  // namespace

Status PictureReader::read(const std::filesystem::path& path, cv::Mat& bgr, RowRange rows) {
  if (auto read = read_bytes(path, bytes_); !read) return read;
  Status decoded = Error{"neither a JPEG nor a PNG picture"};
  if (bytes_.size() >= 8 && png_sig_cmp(bytes_.data(), 0, 8) == 0) {
    decoded = decode_png(bytes_, bgr);
  } else if (bytes_.size() >= 2 && bytes_[0] == 0xFF && bytes_[1] == 0xD8) {
    decoded = jpeg_.decode(bytes_, bgr, rows);
  }
  if (!decoded) return Error{fmt::format("{}: {}", path.string(), decoded.error().message)};
  return Done{};
}

Result<cv::Mat> read_picture(const std::filesystem::path& path) {
  cv::Mat bgr;
  const Status read = PictureReader{}.read(path, bgr);
  if (!read) return read.error();
  return bgr;
}

Status write_png(const std::filesystem::path& path, const cv::Mat& picture, const std::optional<PngNote>& note) {
  if (picture.empty() || (picture.type() != CV_8UC3 && picture.type() != CV_8UC1)) {
    return Error{fmt::format("can't write {}: there is no 8-bit grey or BGR picture", path.string())};
  }
  PngImage png;
  png.image.width = static_cast<png_uint_32>(picture.cols);
  png.image.height = static_cast<png_uint_32>(picture.rows);
  png.image.format = picture.channels() == 3 ? PNG_FORMAT_BGR : PNG_FORMAT_GRAY;
  png.image.flags = PNG_IMAGE_FLAG_FAST;
  std::vector<std::uint8_t> bytes(PNG_IMAGE_PNG_SIZE_MAX(png.image));
  png_alloc_size_t size = bytes.size();
  if (png_image_write_to_memory(&png.image, bytes.data(), &size, 0, picture.data, static_cast<png_int_32>(picture.step),
                                nullptr) == 0) {
    return Error{fmt::format("can't write {}: {}", path.string(), png.image.message)};
  }
  bytes.resize(size);
  if (note) insert_png_note(bytes, *note);
  return write_file(path, bytes);
}

Result<std::optional<std::string>> read_png_note(const std::filesystem::path& path, std::string_view keyword) {
  std::vector<std::uint8_t> bytes;
  if (auto read = read_bytes(path, bytes); !read) return read.error();
  return find_png_note(bytes, keyword);
}

Status write_jpeg(const std::filesystem::path& path, const cv::Mat& picture, int quality) {
  if (picture.empty() || picture.type() != CV_8UC3) {
    return Error{fmt::format("can't write {}: there is no 8-bit BGR picture", path.string())};
  }
  const Result<std::vector<std::uint8_t>> jpeg = encode_jpeg(picture, quality);
  if (!jpeg) return Error{fmt::format("can't write {}: {}", path.string(), jpeg.error().message)};
  return write_file(path, *jpeg);
}

}  // namespace telehug
