// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>

#include "capture/virtual_rig/picture_layer.hpp"

namespace telehug {

// What a layer looks like that moves by (du_px, dv_px) while the shutter is open and is where it is drawn in the middle
// of that time. Its box must have room for it but at the picture's borders, beyond which it goes on as it is there.
class MotionBlur {
 public:
  void apply(PictureLayer& layer, float du_px, float dv_px);

 private:
  cv::Mat before_;
};

}  // namespace telehug
