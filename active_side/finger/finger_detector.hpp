// SPDX-License-Identifier: Apache-2.0
//
// The default detector: every finger that crosses the screen's bottom edge, and where it touches, to parts of a pixel.
//
//   strip      what lies in front of the border, along it            border_strip
//   foreground what differs there from when nobody was there         background_strip
//   overview   the picture about the border, coarsely, with both     overview
//   tips       where in it fingers end: a small trained net          net/overview_net
//   patch      the picture about a tip, at a scale in mm             tip_patch
//   look       where it touches, whether it does: another one        net/tip_net
//
// What the nets learned is in active_side/training; no picture of a real person or of a real rig is in it.
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "calibration/border_curve.hpp"
#include "calibration/rig_camera.hpp"
#include "common/clock.hpp"
#include "common/units.hpp"
#include "finger/background_learner.hpp"
#include "finger/background_strip.hpp"
#include "finger/finger.hpp"
#include "finger/overview.hpp"
#include "net/overview_net.hpp"
#include "net/tip_net.hpp"

namespace telehug {

class FingerDetector {
 public:
  // With the background that was kept (how the strip in front of the border looks with nobody there), or none: then
  // adapt() learns it, and until it has, there are no fingers. Without a camera the picture's scale is taken as that of
  // a usual rig. Throws std::invalid_argument if pictures of this size show too little of the screen.
  FingerDetector(const BorderCurve& border, ImageSize image, const std::optional<BorderStrip>& background,
                 const std::optional<RigCamera>& camera);

  // In no order. `bgr` must be CV_8UC3 of the size given; other pictures hold no finger and are counted.
  // The result lives until the next call. Allocates nothing.
  const Fingers& detect(const cv::Mat& bgr);

  // After detect() of a live camera's frame that can be believed: learns how the rig looks now. `now` never decreases.
  // Allocates nothing.
  void adapt(Timestamp now);
  // Until it knows how the rig looks, and while everything looks different, what detect() finds means nothing.
  [[nodiscard]] const BackgroundLearner& background() const noexcept { return learner_; }

  // The share of the strip that looked as always in the last frame.
  [[nodiscard]] double unchanged_share() const noexcept { return background_.unchanged_share(); }
  [[nodiscard]] std::uint64_t unfit_pictures() const noexcept { return unfit_pictures_; }

 private:
  // What the tip net says of a patch, and where that is in the picture.
  struct Look {
    ImagePoint tip;
    double step_px = 1;  // picture pixels per patch column
    TipLook seen;
  };

  [[nodiscard]] double px_per_mm(const ImagePoint& place) const;
  void add_finger(const cv::Mat& bgr, const ImagePoint& near);
  [[nodiscard]] Look look_once(const cv::Mat& bgr, const ImagePoint& near, bool mirrored);
  [[nodiscard]] std::optional<Finger> look_at(const cv::Mat& bgr, const ImagePoint& near);
  void mark_columns(const Finger& finger);

  BorderCurve border_;
  ImageSize image_;
  std::optional<RigCamera> camera_;
  BorderStrip::Layout layout_;
  BorderStrip strip_;
  BackgroundStrip background_;
  BackgroundLearner learner_;
  Overview overview_;
  std::vector<OverviewNet> overview_nets_;  // one for each width of its tiles
  TipNet tip_net_;
  std::vector<bool> is_finger_;  // columns of the strip
  Fingers fingers_;
  std::uint64_t unfit_pictures_ = 0;
};

}  // namespace telehug
