// SPDX-License-Identifier: Apache-2.0
#include "rendering/felt_touch.hpp"

#include <algorithm>
#include <cmath>

#include "rendering/geometry.hpp"

namespace telehug {
namespace {

// A finger that has gone no farther rests: farther than the place of a resting one is unsure
// (touch/gesture_recogniser.hpp).
constexpr double rest_radius_fh = 0.1;

}  // namespace

FeltTouch::FeltTouch(const Contact& contact, Rendering rendering, Duration least, Timestamp now)
    : contact_(contact),
      rendering_(rendering),
      path_(contact.body, now),
      began_(now),
      pulse_ends_(now + least),
      rest_(contact.body),
      rests_since_(now),
      hugs_since_(now),
      level_(contact.gesture == Gesture::hug ? hug_level({}) : 1, now) {}

void FeltTouch::follow(const Contact& contact, Timestamp now) {
  if (contact.gesture == Gesture::hug && contact_.gesture != Gesture::hug) hugs_since_ = now;
  contact_ = contact;
  path_.lead(contact.body, now);
  note_rest(contact.body, now);
}

void FeltTouch::lift(const Contact& contact, Timestamp now) {
  const Contact before = contact_;
  follow(contact, now);
  // What lifting fingers tell of strength and speed is about the lifting.
  contact_.strength = before.strength;
  contact_.speed_mm_s = std::max(before.speed_mm_s, contact.speed_mm_s);
  if (rendering_ == Rendering::places && contact.gesture == Gesture::pat) pulse_ends_ = began_ + pat_pulse;
  lift(now);
}

void FeltTouch::lift(Timestamp now) {
  if (lifted_) return;
  lifted_ = true;
  path_.end(now);
  ends_ = pulse_ends_;
  if (rendering_ == Rendering::places && !path_.arrived()) ends_ = std::max(ends_, now + longest_lag);
}

bool FeltTouch::over(Timestamp now) const noexcept {
  const bool on_its_way = rendering_ == Rendering::places && !path_.arrived();
  return lifted_ && (now >= ends_ || (now >= pulse_ends_ && !on_its_way));
}

double FeltTouch::strength() const noexcept {
  return std::isfinite(contact_.strength) ? std::clamp(contact_.strength, 0.0, 1.0) : 0;
}

double FeltTouch::level(Timestamp now) {
  return rendering_ == Rendering::boxes ? 1 : level_.follow(level_wanted(now), now);
}

double FeltTouch::level_wanted(Timestamp now) const {
  switch (contact_.gesture) {
    case Gesture::hug:
      return hug_level(now - hugs_since_);
    case Gesture::pat:
      return pat_level;
    case Gesture::stroke:
      // One that has come to rest is a hand that rests.
      return std::min(stroke_level(contact_.speed_mm_s), hold_level(now - rests_since_));
    default:
      return hold_level(now - rests_since_);
  }
}

double FeltTouch::warmth(Timestamp now) const {
  const bool warms = contact_.gesture == Gesture::hold || contact_.gesture == Gesture::hug;
  return warms && !lifted_ ? telehug::warmth(now - rests_since_) : 0;
}

void FeltTouch::note_rest(BodyPoint place, Timestamp now) {
  if (finite(rest_) && finite(place) && distance_fh(rest_, place) <= rest_radius_fh) return;
  rest_ = place;
  rests_since_ = now;
}

}  // namespace telehug
