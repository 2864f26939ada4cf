// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "capture/frame_source.hpp"
#include "capture/virtual_rig/picture_maker.hpp"
#include "capture/virtual_rig/rig_pace.hpp"
#include "capture/virtual_rig/settings.hpp"

namespace telehug {

// What really happened in a frame of a virtual rig.
struct VirtualTruth {
  bool contact = false;
  std::optional<ScreenPoint> screen;  // contact: the touched point; hovering: the fingertip's foot; nobody: none
  std::optional<double> hover_mm;     // only while hovering
  std::optional<ScreenPoint> second;  // the same of the middle finger, if it points as well
};

// Why these settings can't be drawn, if so.
Status check_virtual_rig(const VirtualRigSettings& settings);

// A rendered webcam in front of a rendered monitor, whose user does what a script says. See README.md here.
class VirtualRig final : public FrameSource {
 public:
  // Throws std::invalid_argument with what check_virtual_rig() says. `clock` must outlive the rig.
  VirtualRig(VirtualRigSettings settings, const Clock& clock, SleepUntil sleep = sleep_until_steady);

  Status open() override;
  void close() override;
  [[nodiscard]] bool is_open() const override { return open_; }
  ReadOutcome read(Frame& frame, Duration timeout) override;
  [[nodiscard]] std::string last_error() const override { return last_error_; }
  [[nodiscard]] std::string name() const override { return "virtual"; }
  [[nodiscard]] ImageSize size() const override { return settings_.image; }

  // Of the frame with this sequence number; the same for every run of the same settings.
  [[nodiscard]] VirtualTruth truth(std::uint64_t sequence) const;

  // Pictures for the calibration, as the camera would take them, with noise.
  [[nodiscard]] cv::Mat picture_of_background();
  [[nodiscard]] cv::Mat picture_of_triangle();  // black on white, one vertex in the middle of the screen's lower edge
  [[nodiscard]] cv::Mat picture_of_marks();     // see calibration/calibration_page.hpp
  // On a white dot on a black screen; the pose's place does not matter.
  [[nodiscard]] cv::Mat picture_of_touch(const ScreenPoint& point, const HandPose& pose = {});

  // What the user does in the frame with this sequence number.
  [[nodiscard]] std::vector<HandPose> hands(std::uint64_t sequence) const;

  [[nodiscard]] const VirtualRigSettings& settings() const noexcept { return settings_; }
  [[nodiscard]] const PinholeCamera& camera() const noexcept { return pictures_.camera(); }

 private:
  [[nodiscard]] double script_time_s(std::uint64_t sequence) const;
  cv::Mat picture_of(const cv::Mat& shown, const std::vector<HandPose>& hands);

  VirtualRigSettings settings_;
  RigPace pace_;
  PictureMaker pictures_;
  bool open_ = false;
  std::uint64_t calibration_pictures_ = 0;
  std::string last_error_;
};

// Up to nine points that a calibration of this rig can use, in the order in which they should be touched: the first
// lies in the horizontal middle of the screen, the second 30 mm to the right of it and lower where that can be seen.
// All of them can be seen; points that can't are moved towards the lower middle of the screen.
std::vector<ScreenPoint> calibration_points(const VirtualRigSettings& settings);

}  // namespace telehug
