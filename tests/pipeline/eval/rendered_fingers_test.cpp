// SPDX-License-Identifier: Apache-2.0
//
// The default detector on pictures of virtual rigs that its nets have not learned from, with perfect calibrations: what
// is measured is the detector alone. Seeds below 1,000,000 are never used for training.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "capture/virtual_rig/random_frame.hpp"
#include "capture/virtual_rig/random_rig.hpp"
#include "capture/virtual_rig/rig_renderer.hpp"
#include "detection/make_detector.hpp"
#include "doubles/allocation_counter.hpp"
#include "doubles/perfect_calibration.hpp"

namespace telehug {
namespace {

constexpr std::uint64_t first_rig = 700'001;
constexpr std::uint64_t rigs = 10;

// A rig, its detector, and pictures of it.
class WatchedRig {
 public:
  explicit WatchedRig(std::uint64_t seed)
      : rig_(random_rig(seed)), renderer_(rig_.settings), calibration_(calibration_of(rig_.settings)) {
    renderer_.draw(std::vector<HandPose>{}, 0, empty_);
    detector_ = detector_of(calibration_, empty_);
  }

  RandomFrame draw(FrameKind kind, std::uint64_t seed) {
    RandomFrame frame = random_frame(rig_, kind, seed);
    auto& view = views_[frame.content];
    if (!view) {
      VirtualRigSettings showing = rig_.settings;
      showing.content = frame.content;
      view = renderer_.view(showing);
    }
    renderer_.show(view);
    renderer_.draw(frame.hands, seed, picture_);
    return frame;
  }
  const Fingers& detect() { return telehug::detect(*detector_, picture_); }
  // As if the camera exchanged left and right; where the fingers it sees touch the screen.
  std::vector<ScreenPoint> detect_mirrored() {
    const RigCamera upright = camera_of(rig_.settings);
    const RigCamera camera(upright.parameters(), upright.image(), {.left_right_exchanged = true});
    Calibration exchanged = calibration_;
    std::get<RigCalibration>(exchanged.solved).solution.model.camera = camera;
    exchanged.border = border_line(camera, rig_.settings.screen);
    if (!mirrored_detector_) mirrored_detector_ = detector_of(exchanged, flipped(empty_));
    std::vector<ScreenPoint> places;
    for (const Finger& finger : telehug::detect(*mirrored_detector_, flipped(picture_)))
      places.push_back(camera.screen_point(*finger.contact).value());
    return places;
  }
  [[nodiscard]] ScreenPoint place_of(const Finger& finger) const {
    return camera_of(rig_.settings).screen_point(*finger.contact).value();
  }
  [[nodiscard]] bool mirrors() const { return rig_.group.coat == "glossy"; }

 private:
  static cv::Mat flipped(const cv::Mat& picture) {
    cv::Mat other;
    cv::flip(picture, other, 1);
    return other;
  }
  static std::unique_ptr<AnyDetector> detector_of(const Calibration& calibration, const cv::Mat& empty) {
    const BorderStrip::Layout layout = strip_layout(calibration);
    BorderStrip strip(layout);
    strip.sample(empty, layout);
    return std::make_unique<AnyDetector>(make_detector("default", calibration, strip));
  }

  RandomRig rig_;
  RigRenderer renderer_;
  Calibration calibration_;
  std::unique_ptr<AnyDetector> detector_;
  std::unique_ptr<AnyDetector> mirrored_detector_;
  std::map<ScreenContent, std::shared_ptr<RigView>> views_;
  cv::Mat empty_;
  cv::Mat picture_;
};

struct Errors {
  std::size_t touches = 0;
  std::size_t missed = 0;  // or farther than 10 mm
  std::string which;
  std::vector<double> vertical_mm;
  std::vector<double> horizontal_mm;

  void add(const WatchedRig& rig, const Fingers& fingers, const FingerPlace& truth, const std::string& picture) {
    ++touches;
    double nearest_mm = 10;
    ScreenPoint nearest{};
    for (const Finger& finger : fingers) {
      const ScreenPoint place = rig.place_of(finger);
      const double off_mm = std::hypot(place.x_mm - truth.foot.x_mm, place.y_mm - truth.foot.y_mm);
      if (off_mm >= nearest_mm) continue;
      nearest_mm = off_mm;
      nearest = place;
    }
    if (nearest_mm >= 10) {
      ++missed;
      which += picture + " ";
      return;
    }
    vertical_mm.push_back(std::abs(nearest.y_mm - truth.foot.y_mm));
    horizontal_mm.push_back(std::abs(nearest.x_mm - truth.foot.x_mm));
  }
  static double mean(const std::vector<double>& values) {
    double sum = 0;
    for (const double value : values)
      sum += value;
    return sum / static_cast<double>(values.size());
  }
};

Errors errors_of(FrameKind kind, std::uint64_t frames) {
  Errors errors;
  for (std::uint64_t seed = first_rig; seed < first_rig + rigs; ++seed) {
    WatchedRig rig(seed);
    for (std::uint64_t frame = 1; frame <= frames; ++frame) {
      const RandomFrame drawn = rig.draw(kind, seed * 100 + frame);
      const Fingers& fingers = rig.detect();
      for (const HandPose& hand : drawn.hands) {
        const std::string picture = std::to_string(seed) + "/" + std::to_string(frame);
        errors.add(rig, fingers, hand.finger, picture);
        if (hand.second) errors.add(rig, fingers, *hand.second, picture);
      }
    }
  }
  return errors;
}

TEST(RenderedFingers, AreFoundWhereTheyTouch) {
  const Errors errors = errors_of(FrameKind::touch, 8);
  EXPECT_LE(errors.missed, 3U) << "of " << errors.touches << ": " << errors.which;
  // 0.75 and 0.39; with coarser rows, or patches laid where the net did not learn, 0.81 and more vertically.
  EXPECT_LT(Errors::mean(errors.vertical_mm), 0.79);
  EXPECT_LT(Errors::mean(errors.horizontal_mm), 0.45);
  RecordProperty("vertical_mm", std::to_string(Errors::mean(errors.vertical_mm)));
  RecordProperty("horizontal_mm", std::to_string(Errors::mean(errors.horizontal_mm)));
  RecordProperty("missed", std::to_string(errors.missed));
}

TEST(RenderedFingers, OfOneHandAreBothFound) {
  const Errors errors = errors_of(FrameKind::two_fingers, 4);
  EXPECT_LE(errors.missed, 4U) << "of " << errors.touches << ": " << errors.which;
  EXPECT_LT(Errors::mean(errors.vertical_mm), 1.5);
  EXPECT_LT(Errors::mean(errors.horizontal_mm), 0.9);
}

TEST(RenderedFingers, OfTwoHandsAreBothFound) {
  const Errors errors = errors_of(FrameKind::two_hands, 4);
  EXPECT_LE(errors.missed, 4U) << "of " << errors.touches << ": " << errors.which;
  EXPECT_LT(Errors::mean(errors.vertical_mm), 1.5);
  EXPECT_LT(Errors::mean(errors.horizontal_mm), 0.9);
}

// Each hand is looked at as a left and as a right one, so it hardly matters which one it is.
TEST(RenderedFingers, AreFoundAtTheSamePlacesInAMirroredPicture) {
  std::vector<double> apart_mm;
  for (std::uint64_t seed = first_rig; seed < first_rig + rigs; ++seed) {
    WatchedRig rig(seed);
    for (std::uint64_t frame = 1; frame <= 8; ++frame) {
      rig.draw(FrameKind::touch, seed * 100 + frame);
      const Fingers& fingers = rig.detect();
      const std::vector<ScreenPoint> mirrored = rig.detect_mirrored();
      if (fingers.size() != 1 || mirrored.size() != 1) continue;
      const ScreenPoint place = rig.place_of(fingers.front());
      apart_mm.push_back(std::hypot(place.x_mm - mirrored[0].x_mm, place.y_mm - mirrored[0].y_mm));
    }
  }
  EXPECT_GT(apart_mm.size(), 70U);
  std::sort(apart_mm.begin(), apart_mm.end());
  EXPECT_LT(apart_mm[apart_mm.size() / 2], 0.3);
}

TEST(RenderedFingers, AreNotFoundWhereNobodyIsOrNobodyCrossesTheBorder) {
  int found = 0;
  for (std::uint64_t seed = first_rig; seed < first_rig + rigs; ++seed) {
    WatchedRig rig(seed);
    for (std::uint64_t frame = 1; frame <= 4; ++frame) {
      for (const FrameKind kind : {FrameKind::nohand, FrameKind::away}) {
        rig.draw(kind, seed * 100 + frame);
        found += static_cast<int>(rig.detect().size());
      }
    }
  }
  EXPECT_LE(found, 1) << "in 80 pictures";
}

TEST(RenderedFingers, ThatHoverOverAMirrorAreSeenToHover) {
  int hovering = 0;
  int taken_for_touch = 0;
  int surely_wrong = 0;
  int touching = 0;
  int taken_for_hover = 0;
  for (std::uint64_t seed = first_rig; seed < first_rig + 3 * rigs; ++seed) {
    WatchedRig rig(seed);
    if (!rig.mirrors()) continue;
    for (std::uint64_t frame = 1; frame <= 10; ++frame) {
      const RandomFrame drawn = rig.draw(FrameKind::hover, seed * 100 + frame);
      if (drawn.hands.front().finger.hover_mm >= 10) {
        ++hovering;
        for (const Finger& finger : rig.detect()) {
          taken_for_touch += finger.mirror.state != MirrorState::hovering ? 1 : 0;
          surely_wrong += finger.mirror.state == MirrorState::touching && finger.mirror.log_ratio > 3 ? 1 : 0;
        }
      }
      rig.draw(FrameKind::touch, seed * 100 + frame);
      for (const Finger& finger : rig.detect()) {
        ++touching;
        taken_for_hover += finger.mirror.state == MirrorState::hovering ? 1 : 0;
      }
    }
  }
  ASSERT_GT(hovering, 30);
  EXPECT_LE(taken_for_touch, 0.08 * hovering) << "of " << hovering;
  EXPECT_LE(surely_wrong, 1) << "of " << hovering;
  EXPECT_LE(taken_for_hover, 0.05 * touching) << "of " << touching;
}

TEST(RenderedFingers, AreFoundWithoutTakingMemory) {
  WatchedRig rig(first_rig);
  rig.draw(FrameKind::two_hands, 1);
  rig.detect();
  const auto before = allocation_count();
  const std::size_t found = rig.detect().size();
  EXPECT_EQ(allocation_count(), before);
  EXPECT_GT(found, 0U);
}

}  // namespace
}  // namespace telehug
