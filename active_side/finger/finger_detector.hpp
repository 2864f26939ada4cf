// SPDX-License-Identifier: Apache-2.0
//
// The default detector: every finger that crosses the screen's bottom edge, its tip to parts of a pixel. It knows no
// colour of skin: fingers are what differs from the background in front of the screen, and what looks like that goes on
// over the screen until it ends.
//
//   strip      what lies in front of the border, along it          border_strip
//   foreground what differs there from when nobody was there       background_strip
//   crossings  bands of it with two nearly straight edges          crossing
//   colours    of this finger, and of what is beside it            finger_colours
//   guesses    rows where its tip may be                           tip_search
//   contour    the tip's outline                                   tip_contour
//   tip        the outline's foremost point                        tip_shape
//   mirror     does its mirror image begin there                   mirror_evidence
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
#include "finger/crossing.hpp"
#include "finger/finger.hpp"
#include "finger/tip_contour.hpp"

namespace telehug {

class FingerDetector {
 public:
  // `empty` (CV_8UC3) shows the rig with nobody there; it fixes the size of the pictures. Throws std::invalid_argument
  // if it is no such picture or too small.
  FingerDetector(const BorderCurve& border, const cv::Mat& empty);

  // With the background that was kept, or none: then adapt() learns it, and until it has, there are no fingers. Throws
  // std::invalid_argument if pictures of this size are too small.
  FingerDetector(const BorderCurve& border, ImageSize image, const std::optional<BorderStrip>& background);

  // With the camera the detector also says what the screen's mirror image tells of each finger.
  void know_camera(const RigCamera& camera) { camera_ = camera; }

  // From the strongest crossing on. `bgr` must be CV_8UC3 of the size of `empty`; other pictures hold no finger and are
  // counted. The result lives until the next call. Allocates nothing.
  const Fingers& detect(const cv::Mat& bgr);

  // After detect() of a live camera's frame that can be believed: learns how the rig looks now. `now` never decreases.
  // Allocates nothing.
  void adapt(Timestamp now);
  // Until it knows how the rig looks, and while everything looks different, what detect() finds means nothing.
  [[nodiscard]] const BackgroundLearner& background() const noexcept { return learner_; }

  // The outlines of the last frame's fingers, in their order.
  [[nodiscard]] const boost::container::static_vector<TipContour, max_contacts>& contours() const noexcept {
    return contours_;
  }
  // The share of the strip that looked as always in the last frame.
  [[nodiscard]] double unchanged_share() const noexcept { return background_.unchanged_share(); }
  [[nodiscard]] std::uint64_t unfit_pictures() const noexcept { return unfit_pictures_; }

 private:
  void add_finger(const cv::Mat& bgr, std::size_t which);

  BorderCurve border_;
  ImageSize image_;
  std::optional<RigCamera> camera_;
  BorderStrip::Layout layout_;
  BorderStrip strip_;
  BackgroundStrip background_;
  BackgroundLearner learner_;
  CrossingFinder crossing_finder_;
  EdgeMap edges_;
  FingerColours colours_;
  TipSearch tip_search_;
  TipContourFinder contour_finder_;
  std::vector<FingerAxis> axes_;
  std::vector<FingerAxis> others_;
  std::vector<bool> is_finger_;  // columns of the strip
  Fingers fingers_;
  boost::container::static_vector<TipContour, max_contacts> contours_;
  std::uint64_t unfit_pictures_ = 0;
};

}  // namespace telehug
