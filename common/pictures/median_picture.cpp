// SPDX-License-Identifier: Apache-2.0
#include "pictures/median_picture.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace telehug {

cv::Mat median_picture(const std::vector<cv::Mat>& pictures) {
  cv::Mat median(pictures.front().size(), CV_8UC3);
  std::vector<std::uint8_t> values(pictures.size());
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  for (int row = 0; row < median.rows; ++row) {
    std::uint8_t* const out = median.ptr<std::uint8_t>(row);
    for (int i = 0; i < 3 * median.cols; ++i) {
      for (std::size_t k = 0; k < pictures.size(); ++k)
        values[k] = pictures[k].ptr<std::uint8_t>(row)[i];
      std::nth_element(values.begin(), middle, values.end());
      out[i] = *middle;
    }
  }
  return median;
}

}  // namespace telehug
