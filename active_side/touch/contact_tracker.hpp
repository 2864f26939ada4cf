// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <boost/container/static_vector.hpp>
#include <cstdint>

#include "common/clock.hpp"
#include "common/messages.hpp"
#include "touch/contact_state.hpp"

namespace telehug {

struct TrackerOptions {
  // A point farther than this from where a contact was belongs to another finger: at 30 frames a second a hand that
  // moves fast (1 m/s) goes 33 mm from one frame to the next.
  double gate_mm = 40;
  // A contact whose finger is not seen is held at its last place, and ends with the first of these two.
  int up_after_missed_frames = 3;
  Duration up_after = 100ms;  // since it was last seen
};

// Gives the touch points of each frame identities that live from down to up. Up to max_contacts at a time; a frame's
// points beyond that wait until a place is free. Allocates nothing.
class ContactTracker {
 public:
  explicit ContactTracker(const TrackerOptions& options = {}) : options_(options) {}

  // The contacts of this frame, in the order of their ids: every one that lives once (down, then move, also while it is
  // held, with the time at which it was last seen), and those that end now (up, with this frame's time). The result
  // lives until the next call. `frame_time` must rise; with no frames at all (camera lost), call it with no points and
  // the present time, so that contacts end. With `may_begin` false points that belong to no contact are passed over.
  const ContactStates& update(const ScreenPoints& points, Timestamp frame_time, bool may_begin = true);

 private:
  struct Track {
    ContactState state;  // its time is when the finger was last seen
    int missed_frames = 0;
  };
  using Taken = std::array<bool, max_contacts>;

  void match(const ScreenPoints& points, Timestamp frame_time, Taken& point_taken, Taken& track_taken);
  void end_or_hold(Timestamp frame_time, const Taken& track_taken);
  void begin(const ScreenPoints& points, Timestamp frame_time, const Taken& point_taken);

  TrackerOptions options_;
  boost::container::static_vector<Track, max_contacts> tracks_;
  ContactStates states_;
  std::uint32_t next_id_ = 1;
};

}  // namespace telehug
