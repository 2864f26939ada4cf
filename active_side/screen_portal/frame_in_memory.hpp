// SPDX-License-Identifier: Apache-2.0
//
// Finds a picture in memory that another program describes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <opencv2/core/mat.hpp>

#include "common/result.hpp"
#include "common/units.hpp"

namespace telehug {

// Four bytes a pixel; the fourth is not looked at.
enum class PixelOrder { bgrx, rgbx };

// What the other program says of its picture. Nothing of it has been checked but `data` and `bytes`.
struct FrameInMemory {
  const std::uint8_t* data = nullptr;  // memory that can be read; null: none
  std::size_t bytes = 0;               // as many as can be read
  std::size_t offset = 0;              // where the picture starts, bytes
  std::size_t filled = 0;              // how many bytes the picture has
  std::int64_t stride = 0;             // from a row to the next, bytes; 0: the rows lie side by side
  ImageSize size;
  PixelOrder order = PixelOrder::bgrx;
};

inline constexpr int longest_screen_side_px = 16384;

// The picture where it lies, CV_8UC4, without a copy. Fails if it does not fit into the memory or makes no sense.
Result<cv::Mat> find_frame(const FrameInMemory& frame);

// Copies a picture that was found into `bgrx`, whose memory is used again if it is large enough.
void copy_frame(const cv::Mat& found, PixelOrder order, cv::Mat& bgrx);

}  // namespace telehug
