// SPDX-License-Identifier: Apache-2.0
#include "setup/calibrated_rig.hpp"

#include <system_error>

#include "calibration/calibration_file.hpp"
#include "detection/make_detector.hpp"
#include "detection/upright_picture.hpp"
#include "finger/background_file.hpp"

namespace telehug {

Status save_calibrated_rig(const std::filesystem::path& path, const CalibratedRig& rig) {
  std::error_code problem;
  const std::filesystem::path background = background_file(path);
  if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path(), problem);
  if (!rig.empty) {
    std::filesystem::remove(background, problem);
    return write_calibration(path, rig.calibration);
  }
  UprightPicture turned(rig.calibration.image, is_upside_down(rig.calibration));
  const cv::Mat& empty = turned.of(*rig.empty);
  if (Status written = write_background(background, empty, strip_layout(rig.calibration)); !written) return written;
  return write_calibration(path, rig.calibration);
}

}  // namespace telehug
