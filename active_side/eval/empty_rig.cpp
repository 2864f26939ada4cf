// SPDX-License-Identifier: Apache-2.0
#include "eval/empty_rig.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "pictures/picture_file.hpp"

namespace telehug {

Result<cv::Mat> picture_of_empty_rig(const RigDirectory& rig) {
  if (rig.background) return read_picture(*rig.background);
  constexpr std::size_t fewest = 3;
  std::vector<cv::Mat> pictures;
  for (const CalibrationTouch& touch : rig.calibration) {
    auto picture = read_picture(touch.frame.picture);
    if (!picture) return picture.error();
    if (!pictures.empty() && picture->size() != pictures.front().size()) {
      return Error{
          fmt::format("{}: not of the same size as the other calibration pictures", touch.frame.picture.string())};
    }
    pictures.push_back(*std::move(picture));
  }
  if (pictures.size() < fewest) {
    return Error{fmt::format("{} has neither background.jpg, a picture with nobody there, nor {} calibration pictures",
                             rig.path.string(), fewest)};
  }
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
