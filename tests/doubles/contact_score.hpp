// SPDX-License-Identifier: Apache-2.0
//
// What a contact tracker makes of simulated fingers, against the truth.
#pragma once

#include <array>
#include <cstdlib>
#include <map>
#include <set>
#include <vector>

#include "doubles/simulated_hand.hpp"
#include "touch/contact_tracker.hpp"

namespace telehug {

inline Timestamp simulated_time(double seconds) {
  return Timestamp{1h} + std::chrono::duration_cast<Duration>(std::chrono::duration<double>(seconds));
}

struct ContactScore {
  int contacts = 0;
  std::map<int, int> down_late_frames;  // how often so many frames after the first one in which it touches
  std::map<int, int> up_late_frames;    // after the first one in which it doesn't any more
  int missed = 0;                       // contacts without a down
  int split = 0;                        // contacts with more than one
  int spurious = 0;                     // downs without a contact
  int hovers = 0;
  int hovers_touched = 0;                     // gestures that only hover, with a down
  std::array<int, 4> hovering_frames{};       // from 5, 10, 15, 20 mm
  std::array<int, 4> hovering_touched{};      // those taken for a touch
  std::array<int, 4> hovering_seen_frames{};  // those in which the finger is seen at all
  [[nodiscard]] static double share(int part, int whole) { return whole == 0 ? 0 : double(part) / whole; }
  [[nodiscard]] static double within(const std::map<int, int>& late, int frames) {
    int all = 0, good = 0;
    for (const auto& [by, count] : late) {
      all += count;
      if (std::abs(by) <= frames) good += count;
    }
    return share(good, all);
  }
  [[nodiscard]] double hovering_share(std::size_t from) const {
    int part = 0, whole = 0;
    for (std::size_t i = from; i < hovering_frames.size(); ++i) {
      part += hovering_touched[i];
      whole += hovering_frames[i];
    }
    return share(part, whole);
  }
};

// One finger at a time; every gesture touches at most once.
inline void score_gesture(ContactTracker& tracker, const std::vector<SimulatedFrame>& frames, double start_s,
                          ContactScore& score) {
  constexpr int none = -1000;
  int touched = none, left = none;
  for (int i = 0; i < static_cast<int>(frames.size()); ++i) {
    if (frames[static_cast<std::size_t>(i)].touches()) {
      if (touched == none) touched = i;
      left = i + 1;
    } else if (touched != none && left == i && frames[static_cast<std::size_t>(i)].truth.z_mm < 1) {
      left = i + 1;
    }
  }
  int down = none, up = none, downs = 0;
  for (int i = 0; i < static_cast<int>(frames.size()); ++i) {
    const SimulatedFrame& frame = frames[static_cast<std::size_t>(i)];
    FingerObservations seen;
    if (frame.seen) seen.push_back(*frame.seen);
    bool touching = false;
    for (const ContactState& state : tracker.update(seen, simulated_time(start_s + frame.seconds))) {
      touching = touching || (state.phase != Phase::up && state.touching >= 0.5);
      if (state.phase == Phase::down) {
        const bool real = touched != none && i >= touched - 4 && i <= left;
        if (!real) ++score.spurious;
        if (real && downs++ == 0) down = i;
      }
      if (state.phase == Phase::up) up = i;
    }
    const double h = frame.truth.z_mm;
    if (h >= 5 && h < 60) {
      const std::size_t bin = h < 10 ? 0 : h < 15 ? 1 : h < 20 ? 2 : 3;
      ++score.hovering_frames[bin];
      score.hovering_seen_frames[bin] += frame.seen ? 1 : 0;
      score.hovering_touched[bin] += touching ? 1 : 0;
    }
    if (touched == none && touching && downs >= 0) downs = -1;
  }
  if (touched == none) {
    ++score.hovers;
    if (downs == -1) ++score.hovers_touched;
    return;
  }
  ++score.contacts;
  if (downs == 0) ++score.missed;
  if (downs > 1) ++score.split;
  if (downs > 0) {
    ++score.down_late_frames[down - touched];
    ++score.up_late_frames[up - left];
  }
}

}  // namespace telehug
