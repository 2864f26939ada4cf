// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "capture/virtual_rig/rig_renderer.hpp"

namespace telehug {

// Draws the pictures of a rig with its scripted disturbances. Views that they need are made beforehand.
class PictureMaker {
 public:
  explicit PictureMaker(const VirtualRigSettings& settings);

  // Of the moment `time_s` of the script.
  void draw(const std::vector<HandPose>& hands, double time_s, std::uint64_t index, cv::Mat& bgr);

  [[nodiscard]] const PinholeCamera& camera() const noexcept { return usual_view_->camera; }
  [[nodiscard]] RigRenderer& renderer() noexcept { return renderer_; }

 private:
  std::vector<Disturbance> disturbances_;
  RigRenderer renderer_;
  std::shared_ptr<RigView> usual_view_;
  std::map<std::vector<std::size_t>, std::shared_ptr<RigView>> views_;  // by the disturbances that are on
  cv::Mat before_;
};

}  // namespace telehug
