// SPDX-License-Identifier: Apache-2.0
#include "screen_portal/frame_in_memory.hpp"

#include <fmt/format.h>

#include <opencv2/imgproc.hpp>

namespace telehug {
namespace {

constexpr std::int64_t bytes_per_pixel = 4;

}  // namespace

Result<cv::Mat> find_frame(const FrameInMemory& frame) {
  const auto [width, height] = frame.size;
  if (width <= 0 || height <= 0 || width > longest_screen_side_px || height > longest_screen_side_px) {
    return Error{fmt::format("it would be of {}x{} px", width, height)};
  }
  if (frame.data == nullptr) {
    return Error{"it lies in no memory that can be read"};
  }
  const std::int64_t row = width * bytes_per_pixel;
  const std::int64_t stride = frame.stride == 0 ? row : frame.stride;
  // The upper bound keeps the product below what 64 bits hold.
  if (stride < row || stride > std::int64_t{1} << 31U) {
    return Error{fmt::format("its rows of {} px would lie {} bytes apart", width, frame.stride)};
  }
  const auto needed = static_cast<std::size_t>(stride * (height - 1) + row);
  if (frame.offset > frame.bytes || frame.filled > frame.bytes - frame.offset || needed > frame.filled) {
    return Error{fmt::format("{} bytes are needed for its {}x{} px, and {} of {} from the {}th on are said to be there",
                             needed, width, height, frame.filled, frame.bytes, frame.offset)};
  }
  // cv::Mat knows no constant pixels; who gets it only reads.
  auto* first = const_cast<std::uint8_t*>(frame.data + frame.offset);
  return cv::Mat(height, width, CV_8UC4, first, static_cast<std::size_t>(stride));
}

void copy_frame(const cv::Mat& found, PixelOrder order, cv::Mat& bgrx) {
  if (order == PixelOrder::bgrx) {
    found.copyTo(bgrx);
  } else {
    cv::cvtColor(found, bgrx, cv::COLOR_RGBA2BGRA);
  }
}

}  // namespace telehug
