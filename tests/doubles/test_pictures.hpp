// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <stdexcept>
#include <vector>

#include "pictures/jpeg_encoder.hpp"

namespace telehug {

// A picture of one colour: JPEG keeps it to within a level or two.
inline cv::Mat plain_picture(int width_px, int height_px, const cv::Vec3b& bgr) {
  return {height_px, width_px, CV_8UC3, cv::Scalar(bgr[0], bgr[1], bgr[2])};
}

// Soft slopes that differ from pixel to pixel, so that a JPEG of it has data everywhere.
inline cv::Mat sloping_picture(int width_px, int height_px) {
  cv::Mat picture(height_px, width_px, CV_8UC3);
  for (int row = 0; row < height_px; ++row) {
    for (int column = 0; column < width_px; ++column) {
      picture.at<cv::Vec3b>(row, column) = {static_cast<std::uint8_t>(40 + 150 * column / width_px),
                                            static_cast<std::uint8_t>(60 + 120 * row / height_px),
                                            static_cast<std::uint8_t>(200 - 100 * column / width_px)};
    }
  }
  return picture;
}

inline std::vector<std::uint8_t> jpeg_of(const cv::Mat& picture) {
  auto jpeg = encode_jpeg(picture, 95);
  if (!jpeg) throw std::runtime_error(jpeg.error().message);
  return std::move(jpeg).value();
}

// What webcams send: the same without the segments that define the standard Huffman tables.
inline std::vector<std::uint8_t> without_huffman_tables(const std::vector<std::uint8_t>& jpeg) {
  std::vector<std::uint8_t> kept(jpeg.begin(), jpeg.begin() + 2);
  std::size_t at = 2;
  while (jpeg[at + 1] != 0xDA) {  // up to the start of scan, segments follow each other
    const std::size_t length = 2 + static_cast<std::size_t>(jpeg[at + 2]) * 256 + jpeg[at + 3];
    if (jpeg[at + 1] != 0xC4) {
      kept.insert(kept.end(), jpeg.begin() + static_cast<std::ptrdiff_t>(at),
                  jpeg.begin() + static_cast<std::ptrdiff_t>(at + length));
    }
    at += length;
  }
  kept.insert(kept.end(), jpeg.begin() + static_cast<std::ptrdiff_t>(at), jpeg.end());
  return kept;
}

}  // namespace telehug
