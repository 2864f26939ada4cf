// SPDX-License-Identifier: Apache-2.0
#include "active_pipeline.hpp"

#include <algorithm>
#include <utility>

#include "detection/rows_needed.hpp"
#include "touch/screen_points.hpp"

namespace telehug {
namespace {

// Who means to touch is there within half a second; who waits so long in the air may believe that they do.
constexpr Duration hovers_only_after = 1500ms;

BorderPlace place_of(const BorderLine& border) {
  return {border.v0_px, border.slope};
}

}  // namespace

ActivePipeline::ActivePipeline(const Calibration& calibration, AnyDetector detector,
                               const ActivePipelineOptions& options, TouchStream& stream, const Clock& clock,
                               MetricsRegistry& metrics)
    : image_(calibration.image),
      screen_(calibration.screen),
      rows_needed_(telehug::rows_needed(calibration)),
      upright_(calibration.image, is_upside_down(calibration)),
      camera_watch_(upright(calibration)),
      frame_check_(calibration.image, place_of(upright(calibration).border), options.frames),
      detector_(std::move(detector)),
      tracker_(options.tracker),
      gestures_(options.gestures),
      stream_(stream),
      max_map_age_(options.max_map_age),
      clock_(clock),
      frames_(metrics.counter("frames")),
      frames_by_verdict_{&metrics.counter("frames_good"),   &metrics.counter("frames_of_another_size"),
                         &metrics.counter("frames_blank"),  &metrics.counter("frames_torn"),
                         &metrics.counter("frames_frozen"), &metrics.counter("frames_turned")},
      frames_duplicate_(metrics.counter("frames_duplicate")),
      light_changes_(metrics.counter("light_changes")),
      fingers_off_screen_(metrics.counter("fingers_off_screen")),
      fingers_hovered_(metrics.counter("fingers_hovered")),
      background_relearned_(metrics.counter("background_relearned")),
      touches_seen_(metrics.counter("touches_seen")),
      check_latency_(metrics.latency("frame_check")),
      finger_latency_(metrics.latency("finger")),
      touch_latency_(metrics.latency("touch")),
      box_latency_(metrics.latency("box")) {}

const TouchEvent* ActivePipeline::process(const Frame& frame, const BodyMap& map, bool sending) {
  const Timestamp started = clock_.now();
  const cv::Mat& picture = upright_.of(frame.bgr, frame.rows);
  const FrameFindings findings = frame_check_.check(picture, upright_.rows_of(frame.rows));
  const Timestamp checked = clock_.now();
  check_latency_.record(checked - started);
  count(findings);
  const Timestamp before = newest_;
  const Timestamp time = rising(frame.time);
  if (findings.verdict != FrameVerdict::good) return report(tracker_.pass(time), map, sending, time);

  const Fingers& fingers = detect(detector_, picture);
  if (!findings.settling) adapt(detector_, started);
  finger_latency_.record(clock_.now() - checked);
  camera_watch_.look(picture, !fingers.empty() || !knows_background(), started);
  const bool believed = knows_background() && camera_watch_.trusts_camera();
  const TouchedPoints touched = screen_points(believed ? fingers : Fingers{}, camera_watch_.model(), screen_, image_);
  fingers_off_screen_.add(touched.dropped);
  // What seems to begin while the light changes is the light's doing.
  const Scene scene = findings.settling || !knows_background() ? Scene::disturbed : Scene::steady;
  const Timestamp placed = clock_.now();
  const ContactStates& contacts = tracker_.update(touched.fingers, time, scene);
  touch_latency_.record(clock_.now() - placed);
  count_hovering(before, time);
  return report(contacts, map, sending, time);
}

const TouchEvent* ActivePipeline::process_nothing(const BodyMap& map, bool sending) {
  const Timestamp now = rising(clock_.now());
  return report(tracker_.pass(now), map, sending, now);
}

bool ActivePipeline::knows_background() const noexcept {
  const BackgroundLearner* const learner = background(detector_);
  return learner == nullptr || learner->trusts();
}

void ActivePipeline::count(const FrameFindings& findings) {
  frames_.add();
  frames_by_verdict_[static_cast<std::size_t>(findings.verdict)]->add();
  if (findings.duplicate) frames_duplicate_.add();
  if (findings.settling && !light_settles_) light_changes_.add();
  light_settles_ = findings.settling;
  verdict_ = findings.verdict;
  if (const BackgroundLearner* const learner = background(detector_)) background_relearned_.set(learner->relearned());
}

// Each finger once.
void ActivePipeline::count_hovering(Timestamp before, Timestamp now) {
  for (const HoveringFinger& finger : tracker_.hovering())
    if (now - finger.since >= hovers_only_after && before - finger.since < hovers_only_after) fingers_hovered_.add();
}

Timestamp ActivePipeline::rising(Timestamp time) {
  return newest_ = std::max(time, newest_ + Duration{1});
}

void ActivePipeline::hold_back_contacts() {
  held_back_.clear();
  for (const ContactState& contact : *contacts_)
    held_back_.push_back(contact.id);
}

void ActivePipeline::leave_out_held_back(BoxedContacts& boxed) {
  const auto ended = [this](std::uint32_t id) {
    return std::none_of(contacts_->begin(), contacts_->end(),
                        [id](const ContactState& contact) { return contact.id == id; });
  };
  held_back_.erase(std::remove_if(held_back_.begin(), held_back_.end(), ended), held_back_.end());
  const auto held_back = [this](const BoxedContact& contact) {
    return std::find(held_back_.begin(), held_back_.end(), contact.id) != held_back_.end();
  };
  boxed.erase(std::remove_if(boxed.begin(), boxed.end(), held_back), boxed.end());
}

const TouchEvent* ActivePipeline::report(const ContactStates& contacts, const BodyMap& map, bool sending,
                                         Timestamp frame_time) {
  const Timestamp tracked = clock_.now();
  const auto body = map.version != 0 ? std::optional(map.grid) : std::nullopt;
  contacts_ = &gestures_.update(contacts, body);
  BoxedContacts boxed = sending ? boxes_under(*contacts_, map, max_map_age_, tracked, nobody_) : BoxedContacts{};
  leave_out_held_back(boxed);
  const TouchEvent* event = stream_.build(boxed, map.version, sending, frame_time, clock_.now());

  const auto begins = [](const ContactState& contact) { return contact.phase == Phase::down; };
  touches_seen_.add(static_cast<std::uint64_t>(std::count_if(contacts_->begin(), contacts_->end(), begins)));
  box_latency_.record(clock_.now() - tracked);
  return event;
}

}  // namespace telehug
