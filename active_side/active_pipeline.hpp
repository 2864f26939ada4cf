// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "body_map/body_map.hpp"
#include "boxes_under.hpp"
#include "calibration/calibration_file.hpp"
#include "capture/frame.hpp"
#include "common/clock.hpp"
#include "finger/thesis_detector.hpp"
#include "publish/touch_event_builder.hpp"
#include "service/metrics.hpp"
#include "touch/contact_tracker.hpp"

namespace telehug {

struct ActivePipelineOptions {
  ThesisOptions detector;
  TrackerOptions tracker{.every_finger_touches = true};  // the thesis' detector can't tell
  Duration max_map_age = 3s;
};

// From a picture of the webcam to the event that is sent for it: every stage of the touch path but the camera and the
// wire. One thread uses it; it allocates nothing per frame.
class ActivePipeline {
 public:
  // Throws std::invalid_argument if no finger could be seen with this calibration. `clock`, `metrics` outlive it.
  ActivePipeline(const Calibration& calibration, const ActivePipelineOptions& options, const SessionId& session,
                 const Clock& clock, MetricsRegistry& metrics);

  // The event to send for this frame, or null. Nobody is touched while `sending` is false; contacts that were being
  // sent end. Valid until the next call.
  const TouchEvent* process(const Frame& frame, const BodyMap& map, bool sending);

  // There is no picture (camera lost, nobody wants it): contacts end.
  const TouchEvent* process_nothing(const BodyMap& map, bool sending);

  [[nodiscard]] const ContactStates& contacts() const noexcept { return *contacts_; }
  [[nodiscard]] const NobodyTouched& nobody_touched() const noexcept { return nobody_; }

 private:
  const TouchEvent* report(const ScreenPoints& points, const BodyMap& map, bool sending, Timestamp frame_time);

  ImageSize image_;
  ScreenSize screen_;
  ThesisTouchModel model_;
  ThesisDetector detector_;
  ContactTracker tracker_;
  TouchEventBuilder builder_;
  Duration max_map_age_;
  const Clock& clock_;

  Timestamp newest_{};
  ContactStates none_;
  const ContactStates* contacts_ = &none_;
  NobodyTouched nobody_;
  Counter& frames_;
  Counter& frames_unfit_;
  Counter& fingers_off_screen_;
  Counter& touches_seen_;
  LatencyHistogram& finger_latency_;
  LatencyHistogram& touch_latency_;
  LatencyHistogram& box_latency_;
};

}  // namespace telehug
