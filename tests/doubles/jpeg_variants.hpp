// SPDX-License-Identifier: Apache-2.0
//
// JPEG pictures as other encoders than ours write them: webcams sample colours as they like.
#pragma once

#include <cstdint>
#include <cstdio>  // jpeglib.h needs it first
#include <cstdlib>
#include <opencv2/core.hpp>
#include <vector>

#include <jpeglib.h>

namespace telehug {

struct JpegVariant {
  const char* name;
  int horizontal = 1;  // colours are sampled every so many columns and rows
  int vertical = 1;
  bool grey = false;
  bool progressive = false;
  int restart_rows = 0;  // a restart marker after so many rows of blocks; 0: none
};

inline constexpr JpegVariant jpeg_variants[] = {
    {"4:2:0", 2, 2},
    {"4:2:2", 2, 1},
    {"4:4:4", 1, 1},
    {"4:4:0", 1, 2},
    {"grey", 1, 1, true},
    {"4:2:0 with restart markers", 2, 2, false, false, 1},
    {"4:2:2 with restart markers", 2, 1, false, false, 2},
    {"4:2:0 progressive", 2, 2, false, true},
};

// Noise and slopes: every block differs, and so does every row.
inline cv::Mat busy_picture(int width_px, int height_px, std::uint64_t seed = 1) {
  cv::Mat picture(height_px, width_px, CV_8UC3);
  cv::RNG random(seed);
  for (int row = 0; row < height_px; ++row) {
    for (int column = 0; column < width_px; ++column) {
      for (int c = 0; c < 3; ++c) {
        const int level = 40 + (row * (3 + c) + column * (5 - c)) % 140 + random.uniform(0, 40);
        picture.at<cv::Vec3b>(row, column)[c] = static_cast<std::uint8_t>(level);
      }
    }
  }
  return picture;
}

inline std::vector<std::uint8_t> jpeg_of(const cv::Mat& bgr, const JpegVariant& variant, int quality = 85) {
  jpeg_compress_struct codec{};
  jpeg_error_mgr errors{};
  codec.err = jpeg_std_error(&errors);  // ends the test program: the pictures are good
  jpeg_create_compress(&codec);
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&codec, &bytes, &size);
  codec.image_width = static_cast<JDIMENSION>(bgr.cols);
  codec.image_height = static_cast<JDIMENSION>(bgr.rows);
  codec.input_components = 3;
  codec.in_color_space = JCS_EXT_BGR;
  jpeg_set_defaults(&codec);
  jpeg_set_quality(&codec, quality, TRUE);
  if (variant.grey) jpeg_set_colorspace(&codec, JCS_GRAYSCALE);
  codec.comp_info[0].h_samp_factor = variant.horizontal;
  codec.comp_info[0].v_samp_factor = variant.vertical;
  codec.restart_in_rows = variant.restart_rows;
  if (variant.progressive) jpeg_simple_progression(&codec);
  jpeg_start_compress(&codec, TRUE);
  while (codec.next_scanline < codec.image_height) {
    JSAMPROW row = const_cast<JSAMPROW>(bgr.ptr(static_cast<int>(codec.next_scanline)));
    jpeg_write_scanlines(&codec, &row, 1);
  }
  jpeg_finish_compress(&codec);
  jpeg_destroy_compress(&codec);
  std::vector<std::uint8_t> jpeg(bytes, bytes + size);
  std::free(bytes);  // libjpeg allocates it with malloc
  return jpeg;
}

}  // namespace telehug
