// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <boost/container/static_vector.hpp>
#include <cstdint>
#include <optional>

#include "common/clock.hpp"
#include "common/messages.hpp"
#include "touch/assignment.hpp"
#include "touch/contact_filter.hpp"
#include "touch/contact_smoothing.hpp"
#include "touch/contact_state.hpp"
#include "touch/finger_observation.hpp"

namespace telehug {

struct TrackerOptions {
  // The thesis' detector knows no hovering: every finger that it finds touches, at the place where it is found. Nothing
  // is predicted, weighed or smoothed then.
  bool every_finger_touches = false;
  // A point farther than this from where a finger is expected belongs to another finger: at 30 frames a second a hand
  // that moves fast (1 m/s) goes 33 mm from one frame to the next. Along the line through the camera's foot, where a
  // change of height moves it, three times as far.
  double gate_mm = 40;
  // A contact whose finger is not seen is held at its last place, and ends with the first of these two; or before,
  // where it more likely was lifted out of sight.
  int up_after_missed_frames = 3;
  Duration up_after = 100ms;             // since it was last seen
  Duration up_after_disturbed = 300ms;   // likewise, while the scene is disturbed
  Duration up_after_no_picture = 150ms;  // likewise, while no picture comes; slow cameras deliver 10 a second
  // Probabilities of touching.
  double down_above = 0.65;
  double up_below = 0.4;
  // A finger that touched so surely and is not seen may be found again in the next frame: its contact waits for that.
  double wait_above = 0.85;
  CameraFoot camera = {};
  FingerWidth finger_width = {};  // until somebody has touched; better: as measured in the calibration's touches
  ContactFilterOptions filter = {};
  ContactSmoothingOptions smoothing = {};
};

// A finger in front of the screen, at the place where it would be if it touched.
struct HoveringFinger {
  ScreenPoint screen;
  double touching = 0;  // the probability that it touches
  Timestamp since;      // when it was first seen, or lifted
};
using HoveringFingers = boost::container::static_vector<HoveringFinger, max_contacts>;

// Follows the fingers of each frame from first sight to last, decides which of them touch, and gives each touch an
// identity that lives from down to up. Up to max_contacts fingers at a time; a frame's fingers beyond that wait until a
// place is free. Allocates nothing.
//
// How late: with a mirror image a touch is down in the frame in which it begins or in the next one; without one in the
// next one, when the approach has ended. It is up in the frame in which the finger leaves, or in the next one. How
// often wrong: see ARCHITECTURE.md. A hand that brakes softly and waits a few millimetres off a matt screen moves like
// one that touches softly; then only the width tells, from about 10 mm on. A higher `down_above` takes fewer such hands
// for a touch, and takes longer for soft touches.
class ContactTracker {
 public:
  explicit ContactTracker(const TrackerOptions& options = {}) : options_(options), known_width_(options.finger_width) {}

  // The contacts of this frame, in the order of their ids: every one that lives once (down, then move, also while it is
  // held, with the time at which it was last seen), and those that end now (up, with this frame's time). The result
  // lives until the next call. `frame_time` must rise. In a disturbed scene contacts move, but none begins, and none
  // ends unless its finger is gone for long.
  const ContactStates& update(const FingerObservations& fingers, Timestamp frame_time, Scene scene = Scene::steady);

  // While no frame comes (a slow camera, one that is lost or not wanted): that says nothing about fingers, but after a
  // while contacts end. `now` as `frame_time`.
  const ContactStates& pass(Timestamp now);

  // Of the last frame: fingers that are seen but don't touch.
  [[nodiscard]] const HoveringFingers& hovering() const noexcept { return hovering_; }

 private:
  struct Track {
    ContactFilter filter;
    ContactSmoothing smoothing;
    ScreenPoint seen;  // as observed
    Timestamp seen_at;
    Timestamp in_air_since;  // while it has no contact
    double x_mm_s = 0;       // of `seen`
    double y_mm_s = 0;
    int missed_frames = 0;
    std::optional<ContactState> contact;
    int widths_learned = 0;
  };
  using Taken = std::array<bool, max_contacts>;

  void forget_ended();
  void collect();
  [[nodiscard]] double cost(const Track& track, const ScreenPoint& point, double seconds) const;
  void follow(Track& track, const FingerObservation& finger, Timestamp frame_time, Scene scene);
  void miss(Track& track, Timestamp frame_time, Scene scene);
  void begin(const FingerObservation& finger, Timestamp frame_time);
  void touch_down(Track& track, Timestamp frame_time);
  void learn_width(Track& track);

  TrackerOptions options_;
  boost::container::static_vector<Track, max_contacts> tracks_;
  ContactStates states_;
  HoveringFingers hovering_;
  FingerWidth known_width_;
  std::optional<Timestamp> steady_frame_;  // the last one, if it was steady
  std::uint32_t next_id_ = 1;
};

}  // namespace telehug
