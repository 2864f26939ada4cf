// SPDX-License-Identifier: Apache-2.0
#include "pictures/jpeg_decoder.hpp"

#include <fmt/format.h>

#include <array>
#include <csetjmp>
#include <cstdio>  // jpeglib.h needs it first
#include <new>

#include <jpeglib.h>

#include <jerror.h>

#include "pictures/jpeg_arena.hpp"

namespace telehug {
namespace {

constexpr JDIMENSION max_side_px = 8192;

// What the decoder's `client_data` points to.
struct Client {
  std::jmp_buf failed{};  // where to go on after a failure
  JpegArena arena;
};
Client& client_of(j_common_ptr codec) {
  return *static_cast<Client*>(codec->client_data);
}
JpegArena& arena_of(j_common_ptr codec) {
  return client_of(codec).arena;
}

[[noreturn]] void fail(j_common_ptr codec) {
  std::longjmp(client_of(codec).failed, 1);
}

// Warnings come with level -1. Those that mean lost picture data end the decoding: half a hand must not look like a
// picture. The others are common and harmless (stray bytes between segments, which several webcams send).
void judge_message(j_common_ptr codec, int level) {
  if (level >= 0) return;
  switch (codec->err->msg_code) {
    case JWRN_JPEG_EOF:
    case JWRN_HIT_MARKER:
    case JWRN_HUFF_BAD_CODE:
    case JWRN_MUST_RESYNC:
    case JWRN_ARITH_BAD_CODE:
      fail(codec);
    default:
      ++codec->err->num_warnings;
  }
}

void print_nothing(j_common_ptr /*codec*/) {}

}  // namespace

struct JpegDecoder::State {
  jpeg_decompress_struct codec{};
  jpeg_error_mgr errors{};
  Client client;

  State() {
    codec.err = jpeg_std_error(&errors);
    errors.error_exit = fail;
    errors.emit_message = judge_message;
    errors.output_message = print_nothing;
    codec.client_data = &client;
    if (setjmp(client.failed) != 0) throw std::bad_alloc();  // the only way in which this call fails
    jpeg_create_decompress(&codec);
    client.arena.serve<arena_of>(codec);
  }
  ~State() { jpeg_destroy_decompress(&codec); }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  // The parts between which a C++ object (the picture's memory) is made; no object with a destructor lives in a
  // function that libjpeg jumps back to.
  bool read_header(std::span<const std::uint8_t> jpeg) {
    if (setjmp(client.failed) != 0) return false;
    jpeg_abort_decompress(&codec);
    jpeg_mem_src(&codec, jpeg.data(), jpeg.size());
    jpeg_read_header(&codec, TRUE);
    codec.out_color_space = JCS_EXT_BGR;
    return true;
  }
  // The data of skipped rows are still read, code by code, since only that tells where the next row begins; but they
  // become no pixels.
  bool read_rows(cv::Mat& bgr, RowRange rows) {
    if (setjmp(client.failed) != 0) return false;
    jpeg_start_decompress(&codec);
    const auto block_rows = static_cast<JDIMENSION>(codec.max_v_samp_factor * DCTSIZE);
    const auto skipped = static_cast<JDIMENSION>(rows.first) / block_rows * block_rows;
    if (skipped > 0) jpeg_skip_scanlines(&codec, skipped);
    while (codec.output_scanline < static_cast<JDIMENSION>(rows.end)) {
      JSAMPROW row = bgr.ptr(static_cast<int>(codec.output_scanline));
      jpeg_read_scanlines(&codec, &row, 1);
    }
    jpeg_abort_decompress(&codec);
    return true;
  }

  Error reason() {
    std::array<char, JMSG_LENGTH_MAX> text{};
    errors.format_message(reinterpret_cast<j_common_ptr>(&codec), text.data());
    return Error{fmt::format("damaged JPEG picture: {}", text.data())};
  }
};

JpegDecoder::JpegDecoder() : state_(std::make_unique<State>()) {}
JpegDecoder::~JpegDecoder() = default;
JpegDecoder::JpegDecoder(JpegDecoder&&) noexcept = default;
JpegDecoder& JpegDecoder::operator=(JpegDecoder&&) noexcept = default;

Status JpegDecoder::decode(std::span<const std::uint8_t> jpeg, cv::Mat& bgr, RowRange rows) {
  if (jpeg.empty()) return Error{"damaged JPEG picture: it is empty"};
  if (!state_->read_header(jpeg)) return state_->reason();
  const jpeg_decompress_struct& codec = state_->codec;
  if (codec.image_width > max_side_px || codec.image_height > max_side_px) {
    return Error{fmt::format("JPEG picture of {}x{} pixels; at most {} a side are read", codec.image_width,
                             codec.image_height, max_side_px)};
  }
  const cv::Size size(static_cast<int>(codec.image_width), static_cast<int>(codec.image_height));
  rows = rows.within(size.height);
  if (bgr.size() != size || bgr.type() != CV_8UC3) {
    bgr.create(size, CV_8UC3);
    if (rows.count() < size.height) bgr.setTo(cv::Scalar::all(0));
  }
  if (rows.count() > 0 && !state_->read_rows(bgr, rows)) return state_->reason();
  return Done{};
}

}  // namespace telehug
