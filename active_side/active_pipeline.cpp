// SPDX-License-Identifier: Apache-2.0
#include "active_pipeline.hpp"

#include <algorithm>

#include "touch/screen_points.hpp"

namespace telehug {

ActivePipeline::ActivePipeline(const Calibration& calibration, const ActivePipelineOptions& options,
                               const SessionId& session, const Clock& clock, MetricsRegistry& metrics)
    : image_(calibration.image),
      screen_(calibration.screen),
      model_(calibration.model),
      detector_(calibration.border, calibration.image, options.detector),
      tracker_(options.tracker),
      builder_(session),
      max_map_age_(options.max_map_age),
      clock_(clock),
      frames_(metrics.counter("frames")),
      frames_unfit_(metrics.counter("frames_of_another_size")),
      fingers_off_screen_(metrics.counter("fingers_off_screen")),
      touches_seen_(metrics.counter("touches_seen")),
      finger_latency_(metrics.latency("finger")),
      touch_latency_(metrics.latency("touch")),
      box_latency_(metrics.latency("box")) {}

const TouchEvent* ActivePipeline::process(const Frame& frame, const BodyMap& map, bool sending) {
  const Timestamp started = clock_.now();
  const Fingers& fingers = detector_.detect(frame.bgr);
  finger_latency_.record(clock_.now() - started);
  const TouchedPoints touched = screen_points(fingers, model_, screen_, image_);
  frames_.add();
  frames_unfit_.set(detector_.unfit_pictures());
  fingers_off_screen_.add(touched.dropped);
  return report(touched.points, map, sending, frame.time);
}

const TouchEvent* ActivePipeline::process_nothing(const BodyMap& map, bool sending) {
  return report({}, map, sending, clock_.now());
}

const TouchEvent* ActivePipeline::report(const ScreenPoints& points, const BodyMap& map, bool sending,
                                         Timestamp frame_time) {
  const Timestamp started = clock_.now();
  // A camera that comes back stamps its first frame a little before the time at which it was last missed.
  frame_time = newest_ = std::max(frame_time, newest_ + Duration{1});
  contacts_ = &tracker_.update(without_evidence(points), frame_time);
  const Timestamp tracked = clock_.now();
  const BoxedContacts boxed = sending ? boxes_under(*contacts_, map, max_map_age_, tracked, nobody_) : BoxedContacts{};
  const TouchEvent* event = builder_.build(boxed, map.shape, map.version, frame_time, clock_.now());

  const auto begins = [](const ContactState& contact) { return contact.phase == Phase::down; };
  touches_seen_.add(static_cast<std::uint64_t>(std::count_if(contacts_->begin(), contacts_->end(), begins)));
  touch_latency_.record(tracked - started);
  box_latency_.record(clock_.now() - tracked);
  return event;
}

}  // namespace telehug
