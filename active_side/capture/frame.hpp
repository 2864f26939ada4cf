// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>

#include "common/clock.hpp"
#include "common/row_range.hpp"

namespace telehug {

// One picture of the webcam. `bgr` is CV_8UC3 and is reused: it holds until the next read into the same Frame.
struct Frame {
  cv::Mat bgr;
  RowRange rows;               // of bgr that show this picture; the others may show an earlier one, or black
  std::uint64_t sequence = 0;  // counts up by one a frame of the source; a gap is a frame that was lost
  Timestamp time;              // when the picture was taken (kernel stamp for a webcam)
};

}  // namespace telehug
