// SPDX-License-Identifier: Apache-2.0
#include "touch/gesture_recogniser.hpp"

#include <algorithm>
#include <cmath>

namespace telehug {
namespace {

double distance_mm(const ScreenPoint& a, const ScreenPoint& b) {
  return std::hypot(a.x_mm - b.x_mm, a.y_mm - b.y_mm);
}

}  // namespace

const ContactStates& GestureRecogniser::update(const ContactStates& contacts, const std::optional<ScreenRect>& grid) {
  states_ = contacts;
  for (ContactState& contact : states_) {
    Track& track = track_of(contact);
    const bool lasts = contact.phase != Phase::up;
    if (lasts) track.seen_at = contact.frame_time;
    const bool rested = track.seen_at - track.began_at >= options_.hold_after;
    const bool may_stroke = track.gesture == Gesture::none || track.gesture == Gesture::hold;
    if (may_stroke && distance_mm(contact.screen, track.began) >= options_.stroke_from_mm) {
      track.gesture = Gesture::stroke;
    } else if (track.gesture == Gesture::none && rested) {
      track.gesture = Gesture::hold;
    } else if (track.gesture == Gesture::none && !lasts) {
      track.gesture = tap_or_pat(track, contact.screen);
    }
  }
  if (grid) hug(*grid);
  for (ContactState& contact : states_)
    contact.gesture = std::ranges::find(tracks_, contact.id, &Track::id)->gesture;
  const auto is_over = [&](const Track& track) {
    const auto contact = std::ranges::find(states_, track.id, &ContactState::id);
    return contact == states_.end() || contact->phase == Phase::up;
  };
  tracks_.erase(std::remove_if(tracks_.begin(), tracks_.end(), is_over), tracks_.end());
  return states_;
}

// The contact's own, new with its down. If there is no room, one of the contacts before has vanished without an up.
GestureRecogniser::Track& GestureRecogniser::track_of(const ContactState& contact) {
  auto track = std::ranges::find(tracks_, contact.id, &Track::id);
  const bool known = track != tracks_.end();
  if (!known && tracks_.size() == tracks_.capacity()) {
    const auto vanished = [&](const Track& old) {
      return std::ranges::find(states_, old.id, &ContactState::id) == states_.end();
    };
    tracks_.erase(std::ranges::find_if(tracks_, vanished));
  }
  if (!known) track = tracks_.insert(tracks_.end(), Track{});
  if (!known || contact.phase == Phase::down) {
    *track = {contact.id, contact.screen, contact.frame_time, contact.frame_time, Gesture::none};
  }
  return *track;
}

Gesture GestureRecogniser::tap_or_pat(const Track& track, const ScreenPoint& at) {
  const bool pat = std::ranges::any_of(taps_, [&](const Tap& tap) {
    const Duration between = track.began_at - tap.ended;
    return tap.known && between > Duration::zero() && between <= options_.pat_within &&
           distance_mm(tap.at, at) <= options_.pat_within_mm;
  });
  taps_[next_tap_] = {at, track.seen_at, true};
  next_tap_ = (next_tap_ + 1) % taps_.size();
  return pat ? Gesture::pat : Gesture::tap;
}

// A contact that is being lifted is not held any more, but one that was part of a hug stays one.
void GestureRecogniser::hug(const ScreenRect& grid) {
  const double middle_mm = grid.x_mm + grid.width_mm / 2;
  const double aside_mm = options_.middle_part * grid.width_mm / 2;
  const auto side_of = [&](const ContactState& contact) {
    const double x_mm = contact.screen.x_mm;
    const double y_mm = contact.screen.y_mm;
    const bool on_body = x_mm >= grid.x_mm && x_mm <= grid.x_mm + grid.width_mm && y_mm >= grid.y_mm &&
                         y_mm <= grid.y_mm + grid.height_mm;
    if (!on_body || std::abs(x_mm - middle_mm) <= aside_mm) return 0;
    return x_mm < middle_mm ? -1 : 1;
  };
  const auto holds = [&](const ContactState& contact) {
    const auto track = std::ranges::find(tracks_, contact.id, &Track::id);
    return contact.phase != Phase::up && (track->gesture == Gesture::hold || track->gesture == Gesture::hug);
  };
  const auto held_on = [&](int side) {
    return std::ranges::any_of(states_, [&](const ContactState& c) { return holds(c) && side_of(c) == side; });
  };
  if (!held_on(-1) || !held_on(1)) return;
  for (const ContactState& contact : states_) {
    if (holds(contact) && side_of(contact) != 0)
      std::ranges::find(tracks_, contact.id, &Track::id)->gesture = Gesture::hug;
  }
}

}  // namespace telehug
