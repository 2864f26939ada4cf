// SPDX-License-Identifier: Apache-2.0
//
// The whole touch path, from a drawn picture to the event that is sent for it.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <opencv2/core.hpp>
#include <string>
#include <utility>

#include "active_pipeline.hpp"
#include "body_map/vitruvian_grid.hpp"
#include "detection/make_detector.hpp"
#include "doubles/drawn_finger.hpp"
#include "doubles/example_messages.hpp"
#include "doubles/fake_clock.hpp"

namespace telehug {

inline constexpr ImageSize image{1280, 720};
inline constexpr BorderLine border{520, 0};
inline constexpr ScreenSize screen{400, 300, 1280, 960};
inline constexpr Duration frame_period = 33ms;

// A camera 60 mm above the screen's top: a point y below it is seen past the border by 28800 px mm (1 / (y + 60) -
// 1 / 360), and one x beside the middle in column 900 x / (y + 60).
inline Calibration calibration() {
  const std::array touches{MeasuredTouch{{200, 100}, 28800 * (1 / 160.0 - 1 / 360.0), 0},
                           MeasuredTouch{{230, 220}, 28800 * (1 / 280.0 - 1 / 360.0), 900 * 30 / 280.0}};
  auto model = ThesisTouchModel::solve(screen, touches[0], touches[1]);
  return {"drawn", "2026-11-22T00:00:00Z", image, screen, border, ThesisCalibration{touches, model.value()}};
}

// As `run` chooses it; for the default one nobody() shows the empty rig.
inline AnyDetector detector_of(const Calibration& rig, const std::string& choice, const cv::Mat& empty) {
  const BorderStrip::Layout layout = strip_layout(rig);
  BorderStrip background(layout);
  background.sample(empty, layout);
  return make_detector(choice, rig, background);
}

class ActivePipelineTest : public testing::Test {
 protected:
  ActivePipelineTest() {
    // A face 60 mm high: boxes of 30 mm, the grid from (125, 80) to (275, 300).
    map = make_body_map({160, 20, 80, 60}, {0, 0, 400, 300}).value();
    map.version = 7;
    map.seen = clock.now();
  }

  // A finger whose tip is at (200, 150) mm, in box 13.
  static const cv::Mat& touching() {
    static const cv::Mat picture = DrawnScene(border, image).finger(613, 55, 57).noise(1, 4).picture();
    return picture;
  }
  static const cv::Mat& nobody() {
    static const cv::Mat picture = DrawnScene(border, image).noise(2, 4).picture();
    return picture;
  }

  const TouchEvent* see(const cv::Mat& picture, bool sending = true) { return see_with(pipeline, picture, sending); }
  const TouchEvent* see_with(ActivePipeline& seeing, const cv::Mat& picture, bool sending = true) {
    clock.advance(frame_period);
    frame.bgr = picture;
    ++frame.sequence;
    frame.time = clock.now() - 5ms;
    return seeing.process(frame, map, sending);
  }
  const TouchEvent* see_for(Duration time, ActivePipeline& seeing, const cv::Mat& picture) {
    const TouchEvent* event = nullptr;
    for (const Timestamp end = clock.now() + time; clock.now() < end;) {
      map.seen = clock.now();
      event = see_with(seeing, picture);
    }
    return event;
  }
  const TouchEvent* miss(Duration after = frame_period) {
    clock.advance(after);
    return pipeline.process_nothing(map, true);
  }
  std::uint64_t counter(const char* name) { return metrics.counter(name).value(); }

  FakeClock clock;
  MetricsRegistry metrics;
  TouchStream stream{example_session};
  BodyMap map;
  Frame frame;
  static ActivePipelineOptions options() {
    ActivePipelineOptions options;
    options.frames.frozen_after = 0;  // the drawn pictures stand still
    return options;
  }
  ActivePipeline pipeline_with(AnyDetector detector, const Calibration& rig = calibration()) {
    return {rig, std::move(detector), options(), stream, clock, metrics};
  }
  ActivePipeline pipeline = pipeline_with(detector_of(calibration(), "default", nobody()));
};

}  // namespace telehug
