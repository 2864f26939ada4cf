// SPDX-License-Identifier: Apache-2.0
#include "eval/empty_rig.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <vector>

#include "pictures/median_picture.hpp"
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
  return median_picture(pictures);
}

}  // namespace telehug
