// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <span>

#include "common/result.hpp"

namespace telehug {

// Decodes JPEG and MJPEG pictures (also those of webcams that leave out the Huffman tables) with one decoder that is
// set up once. Not for use by two threads at a time.
class JpegDecoder {
 public:
  JpegDecoder();  // throws std::bad_alloc
  ~JpegDecoder();
  JpegDecoder(const JpegDecoder&) = delete;
  JpegDecoder& operator=(const JpegDecoder&) = delete;
  JpegDecoder(JpegDecoder&&) noexcept;
  JpegDecoder& operator=(JpegDecoder&&) noexcept;

  // Fills `bgr` (CV_8UC3), whose memory is kept if its size fits. A damaged or cut-off picture is an error, and `bgr`
  // then holds no picture. Pictures of more than 8192 pixels a side are refused.
  Status decode(std::span<const std::uint8_t> jpeg, cv::Mat& bgr);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace telehug
