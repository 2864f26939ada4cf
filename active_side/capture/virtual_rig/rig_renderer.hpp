// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "capture/virtual_rig/development.hpp"
#include "capture/virtual_rig/hand_pose.hpp"
#include "capture/virtual_rig/hand_shading.hpp"
#include "capture/virtual_rig/mesh_raster.hpp"
#include "capture/virtual_rig/mirror_blur.hpp"
#include "capture/virtual_rig/motion_blur.hpp"
#include "capture/virtual_rig/picture_layer.hpp"
#include "capture/virtual_rig/pinhole_camera.hpp"
#include "capture/virtual_rig/rig_view.hpp"
#include "capture/virtual_rig/settings.hpp"

namespace telehug {

// Draws the pictures of a virtual rig: the scene is rendered once, a frame only adds hands, their shadows and mirror
// images, and what lens and sensor do to them.
class RigRenderer {
 public:
  explicit RigRenderer(const VirtualRigSettings& settings);

  // Shows another picture on the screen (CV_8UC3).
  void show(const cv::Mat& picture);

  // The same in two steps, for views that are wanted again: other screen pictures, light or places of the camera. Lens,
  // sensor, coat and size are those of this renderer's settings.
  [[nodiscard]] std::shared_ptr<RigView> view(const VirtualRigSettings& settings);
  [[nodiscard]] std::shared_ptr<RigView> view() const { return view_; }
  void show(std::shared_ptr<RigView> view) { view_ = std::move(view); }

  // What moves on the screen of the view that is shown is there where it is at that time.
  void move_screen(double time_s);

  // No hands: nobody there. The same `noise_index` gives the same noise and exposure.
  void draw(const std::vector<HandPose>& hands, std::uint64_t noise_index, cv::Mat& bgr);

  // One hand in its usual pose, or nobody.
  void draw(const std::optional<FingerPlace>& finger, std::uint64_t noise_index, cv::Mat& bgr);

  // Pictures without the mirror images of hands, to see what they change.
  void leave_out_mirror_images(bool leave_out) noexcept { mirror_images_ = !leave_out; }

  [[nodiscard]] const PinholeCamera& camera() const noexcept { return view_->camera; }

 private:
  struct KnownShape {
    HandPose pose;
    HandShape shape;
  };

  const HandShape& shape_of(const HandPose& pose);
  void forget_before();
  bool raster(bool mirrored, const ImagePoint& motion_px);
  [[nodiscard]] ImagePoint motion_px(const HandPose& hand, bool mirrored) const;
  void add_shadows();
  void compose();
  void compose(const cv::Rect& box);
  void compose_row(int v, const cv::Range& columns, Light* row);

  VirtualRigSettings settings_;
  Development development_;
  MirrorBlur mirror_blur_;
  MotionBlur motion_blur_;
  MeshRaster raster_;
  std::shared_ptr<RigView> view_;
  std::vector<std::shared_ptr<const KnownShape>> shapes_;  // the newest last

  // Of the picture that is being drawn, or was drawn before.
  cv::Mat coded_;
  std::shared_ptr<RigView> coded_view_;  // `coded_` is its picture but for these boxes:
  std::vector<cv::Rect> changed_;
  std::vector<std::shared_ptr<const KnownShape>> drawn_;
  std::vector<SeenHand> seen_;
  std::vector<std::array<const RasterVertex*, 3>> triangles_;  // those that face the camera
  std::vector<float> shadow_factor_;                           // of a row
  std::vector<std::uint16_t> shares_;  // of the light that is left, for a row's blue, green and red values
  bool mirror_images_ = true;
  bool blurred_ = false;  // the hand is in hand_, else in raster_
  PictureLayer hand_;
  PictureLayer mirror_image_;
};

}  // namespace telehug
