// SPDX-License-Identifier: Apache-2.0
#include "pictures/jpeg_encoder.hpp"

#include <fmt/format.h>

#include <array>
#include <csetjmp>
#include <cstdio>  // jpeglib.h needs it first
#include <cstdlib>

#include <jpeglib.h>

namespace telehug {
namespace {

[[noreturn]] void fail(j_common_ptr codec) {
  std::longjmp(*static_cast<std::jmp_buf*>(codec->client_data), 1);
}
void print_nothing(j_common_ptr /*codec*/) {}

struct Encoder {
  jpeg_compress_struct codec{};
  jpeg_error_mgr errors{};
  std::jmp_buf failed{};
  unsigned char* bytes = nullptr;
  unsigned long size = 0;

  Encoder() {
    codec.err = jpeg_std_error(&errors);
    errors.error_exit = fail;
    errors.output_message = print_nothing;
    codec.client_data = &failed;
  }
  ~Encoder() {
    jpeg_destroy_compress(&codec);
    std::free(bytes);  // libjpeg allocates it with malloc
  }
  Encoder(const Encoder&) = delete;
  Encoder& operator=(const Encoder&) = delete;

  // No object with a destructor lives in the function that libjpeg jumps back to.
  bool encode(const cv::Mat& bgr, int quality) {
    if (setjmp(failed) != 0) return false;
    jpeg_create_compress(&codec);
    jpeg_mem_dest(&codec, &bytes, &size);
    codec.image_width = static_cast<JDIMENSION>(bgr.cols);
    codec.image_height = static_cast<JDIMENSION>(bgr.rows);
    codec.input_components = 3;
    codec.in_color_space = JCS_EXT_BGR;
    jpeg_set_defaults(&codec);
    jpeg_set_quality(&codec, quality, TRUE);
    jpeg_start_compress(&codec, TRUE);
    while (codec.next_scanline < codec.image_height) {
      JSAMPROW row = const_cast<JSAMPROW>(bgr.ptr(static_cast<int>(codec.next_scanline)));
      jpeg_write_scanlines(&codec, &row, 1);
    }
    jpeg_finish_compress(&codec);
    return true;
  }
};

}  // namespace

Result<std::vector<std::uint8_t>> encode_jpeg(const cv::Mat& bgr, int quality) {
  if (bgr.empty() || bgr.type() != CV_8UC3) return Error{"only 8-bit BGR pictures can become JPEG"};
  Encoder encoder;
  if (encoder.encode(bgr, quality)) return std::vector<std::uint8_t>(encoder.bytes, encoder.bytes + encoder.size);
  std::array<char, JMSG_LENGTH_MAX> text{};
  encoder.errors.format_message(reinterpret_cast<j_common_ptr>(&encoder.codec), text.data());
  return Error{fmt::format("the picture can't become a JPEG: {}", text.data())};
}

}  // namespace telehug
