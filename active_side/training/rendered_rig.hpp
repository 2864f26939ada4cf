// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "calibration/rig_camera.hpp"
#include "capture/virtual_rig/random_frame.hpp"
#include "capture/virtual_rig/rig_renderer.hpp"

namespace telehug {

// One fingertip in a picture, as the nets shall see it.
struct TipTruth {
  ImagePoint place;      // touching: the middle of the contact patch; else the foremost point
  bool crosses = false;  // it is on the screen's side of the bottom edge's image
  bool touches = false;
  double hover_mm = 0;
  double width_px = 0;  // of the finger
};

struct RenderedFrame {
  cv::Mat bgr;
  std::vector<TipTruth> tips;
};

// A rig drawn at random, what its screen shows in half of its frames being one of `pictures`, and the camera as a
// perfect calibration would know it.
class RenderedRig {
 public:
  RenderedRig(std::uint64_t seed, const std::vector<cv::Mat>& pictures);

  [[nodiscard]] const RigCamera& camera() const noexcept { return camera_; }
  [[nodiscard]] const ScreenSize& screen() const noexcept { return rig_.settings.screen; }

  // Nobody there, black screen.
  cv::Mat background();
  RenderedFrame frame(std::uint64_t index);

 private:
  [[nodiscard]] RandomFrame random_picture(FrameKind kind, std::uint64_t seed) const;
  std::shared_ptr<RigView> view_of(const RandomFrame& frame, bool picture);

  RandomRig rig_;
  cv::Mat picture_;
  std::unique_ptr<RigRenderer> renderer_;
  std::map<int, std::shared_ptr<RigView>> views_;
  RigCamera camera_;
};

}  // namespace telehug
