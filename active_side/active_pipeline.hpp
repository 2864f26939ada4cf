// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "body_map/body_map.hpp"
#include "boxes_under.hpp"
#include "calibration/calibration.hpp"
#include "calibration/camera_watch.hpp"
#include "capture/frame.hpp"
#include "capture/frame_check.hpp"
#include "common/clock.hpp"
#include "detection/upright_picture.hpp"
#include "finger/any_detector.hpp"
#include "publish/touch_stream.hpp"
#include "service/metrics.hpp"
#include "touch/contact_tracker.hpp"
#include "touch/gesture_recogniser.hpp"

namespace telehug {

struct ActivePipelineOptions {
  FrameCheckOptions frames;
  TrackerOptions tracker{.every_finger_touches = true};  // see tracker_options()
  GestureOptions gestures;
  Duration max_map_age = 3s;
};

// From a picture of the webcam to the event that is sent for it: every stage of the touch path but the camera and the
// wire. One thread uses it; it allocates nothing per frame.
class ActivePipeline {
 public:
  // `detector` is made for the upright() calibration. `stream`, `clock`, `metrics` outlive it.
  ActivePipeline(const Calibration& calibration, AnyDetector detector, const ActivePipelineOptions& options,
                 TouchStream& stream, const Clock& clock, MetricsRegistry& metrics);

  // The event to send for this frame, or null. No finger touches anybody while `sending` is false; contacts that were
  // being sent end. Valid until the stream's next event.
  const TouchEvent* process(const Frame& frame, const BodyMap& map, bool sending);

  // There is no picture (camera lost, nobody wants it): contacts end.
  const TouchEvent* process_nothing(const BodyMap& map, bool sending);

  // The contacts of the last frame are sent to nobody until they end, whatever `sending` says then.
  void hold_back_contacts();

  // What is needed of the next frame: the rows in which fingers are looked for, now and then all.
  [[nodiscard]] RowRange rows_needed() const noexcept {
    return frame_check_.wants_whole_pictures() ? RowRange{} : rows_needed_;
  }
  [[nodiscard]] const ContactStates& contacts() const noexcept { return *contacts_; }
  // Of the last frame, or when it was missing.
  [[nodiscard]] Timestamp time() const noexcept { return newest_; }
  [[nodiscard]] const ScreenSize& screen() const noexcept { return screen_; }
  // Of the newest picture.
  [[nodiscard]] FrameVerdict verdict() const noexcept { return verdict_; }
  // False: the detector learns how the rig looks with nobody there; until then no finger touches.
  [[nodiscard]] bool knows_background() const noexcept;
  // While the camera is `moved`, no finger touches.
  [[nodiscard]] DriftState camera_drift() const noexcept { return camera_watch_.state(); }
  [[nodiscard]] const NobodyTouched& nobody_touched() const noexcept { return nobody_; }

 private:
  void count(const FrameFindings& findings);
  void count_hovering(Timestamp before, Timestamp now);
  // From here on time rises: a camera that comes back stamps its first frame a little before it was last missed.
  Timestamp rising(Timestamp time);
  void leave_out_held_back(BoxedContacts& boxed);
  const TouchEvent* report(const ContactStates& contacts, const BodyMap& map, bool sending, Timestamp frame_time);

  ImageSize image_;
  ScreenSize screen_;
  RowRange rows_needed_;
  UprightPicture upright_;
  CameraWatch camera_watch_;
  FrameCheck frame_check_;
  AnyDetector detector_;
  ContactTracker tracker_;
  GestureRecogniser gestures_;
  TouchStream& stream_;
  Duration max_map_age_;
  const Clock& clock_;

  Timestamp newest_{};
  ContactStates none_;
  const ContactStates* contacts_ = &none_;
  boost::container::static_vector<std::uint32_t, max_contacts> held_back_;  // ids
  NobodyTouched nobody_;
  FrameVerdict verdict_ = FrameVerdict::good;
  bool light_settles_ = false;
  Counter& frames_;
  std::array<Counter*, 6> frames_by_verdict_;
  Counter& frames_duplicate_;
  Counter& light_changes_;
  Counter& fingers_off_screen_;
  Counter& fingers_hovered_;
  Counter& background_relearned_;
  Counter& touches_seen_;
  LatencyHistogram& check_latency_;
  LatencyHistogram& finger_latency_;
  LatencyHistogram& touch_latency_;
  LatencyHistogram& box_latency_;
};

}  // namespace telehug
