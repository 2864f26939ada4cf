// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <span>

#include "common/result.hpp"
#include "common/row_range.hpp"

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

  // Fills `rows` of `bgr` (CV_8UC3 of the picture's full size, whose memory is kept if its size fits), the same to the
  // bit as all rows would be filled. The other rows keep what they held (black, if the memory is new), but for some
  // next to `rows` that are filled as well. A picture that is damaged or cut off before the last of `rows` is an error,
  // and `bgr` then holds no picture; what comes after it is not looked at. Pictures of more than 8192 pixels a side are
  // refused.
  Status decode(std::span<const std::uint8_t> jpeg, cv::Mat& bgr, RowRange rows = {});

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace telehug
