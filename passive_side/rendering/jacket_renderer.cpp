// SPDX-License-Identifier: Apache-2.0
#include "rendering/jacket_renderer.hpp"

#include <algorithm>

#include "rendering/box_table.hpp"
#include "rendering/geometry.hpp"
#include "rendering/warmers.hpp"

namespace telehug {
namespace {

// Between two commands that only make something a little stronger or weaker: the wire has room for 50 frames/s.
constexpr Duration least_between = 20ms;

// A stroke is fast if a motor has it for a time of less than this many bursts. Slower ones need none: what is near to
// their place runs for long enough.
constexpr double bursts_of_slow_stroke = 4;

double seconds(Duration duration) {
  return std::chrono::duration<double>(duration).count();
}

bool holds(const TouchEvent& event, std::uint32_t contact_id) {
  return std::ranges::any_of(event.contacts, [contact_id](const Contact& contact) {
    return contact.id == contact_id && contact.phase != Phase::up;
  });
}

bool answered_as_contact(const TouchEvent& event, const Transition& transition) {
  return transition.event_sequence == event.sequence &&
         std::ranges::any_of(event.contacts, [&transition](const Contact& contact) {
           return contact.id == transition.contact.id && contact.phase == transition.contact.phase;
         });
}

bool stale(const TouchEvent& event, const Transition& transition) {
  // As unsigned numbers, so that no pair of times from outside overflows.
  const auto age_ns =
      static_cast<std::uint64_t>(event.frame_time_ns) - static_cast<std::uint64_t>(transition.frame_time_ns);
  return event.frame_time_ns < transition.frame_time_ns ||
         age_ns > static_cast<std::uint64_t>(std::chrono::nanoseconds(oldest_tap).count());
}

// The camera sees the front. A jacket that has motors on the back alone is felt there, if a touch may be felt elsewhere
// than it is seen.
BodySide seen_side(const JacketProfile& profile) {
  const bool back_instead = profile.uncovered == Uncovered::nearest && MotorMesh(profile, BodySide::front).empty();
  return back_instead ? BodySide::back : BodySide::front;
}

Pace pace_of(const JacketProfile& profile, const MotorMesh& mesh) {
  if (profile.rendering == Rendering::boxes) return {};
  return {mesh.pitch_fh() / seconds(burst_distance), mesh.pitch_fh()};
}

}  // namespace

void JacketRenderer::Wish::add(double more, Timestamp until) noexcept {
  end = strength > 0 ? std::max(end, until) : until;
  strength = std::max(strength, more);
}

JacketRenderer::JacketRenderer(const JacketProfile& profile, Duration drive_duration)
    : profile_(profile),
      drive_duration_(drive_duration),
      seen_side_(seen_side(profile)),
      seen_(profile, seen_side_),
      back_(profile, BodySide::back),
      pace_(pace_of(profile, seen_)) {
  for (std::size_t index = 0; index < std::min(profile.actuators.size(), max_actuators); ++index)
    shapers_.emplace_back(profile.actuators[index]);
  reset();
}

void JacketRenderer::reset() noexcept {
  touches_.clear();
  bursts_ = {};
  for (DriveShaper& shaper : shapers_)
    shaper.forget();
  vouched_until_ = Timestamp::min();
  told_ = {};
}

const JacketPlan& JacketRenderer::plan(const TouchEvent& event, std::span<const Transition> fresh, Timestamp now) {
  follow_clock(now);
  fresh = fresh.first(std::min(fresh.size(), max_transitions));
  if (now >= vouched_until_) touches_.clear();  // what was not heard of for so long is another touch
  vouched_until_ = now + drive_duration_;
  answer(event, fresh);
  feel(event, fresh, now);
  compose(now);
  plan_.drives.clear();
  for (DriveShaper& shaper : shapers_) {
    if (const auto drive = shaper.state(now)) plan_.drives.push_back(*drive);
    shaper.told(now);
  }
  told_ = now;
  return plan_;
}

const Drives& JacketRenderer::tick(Timestamp now) {
  follow_clock(now);
  compose(now);
  plan_.drives.clear();
  const auto has_news = [now](DriveShaper::News least) {
    return [now, least](const DriveShaper& shaper) { return shaper.news(now) >= least; };
  };
  const bool due = now - told_ >= least_between && std::ranges::any_of(shapers_, has_news(DriveShaper::News::slight));
  if (!due && std::ranges::none_of(shapers_, has_news(DriveShaper::News::urgent))) return plan_.drives;
  for (DriveShaper& shaper : shapers_) {
    if (shaper.news(now) == DriveShaper::News::none) continue;
    if (const auto drive = shaper.state(now)) plan_.drives.push_back(*drive);
    shaper.told(now);
  }
  told_ = now;
  return plan_.drives;
}

void JacketRenderer::answer(const TouchEvent& event, std::span<const Transition> fresh) {
  plan_.answers.clear();
  const auto add = [this](std::uint64_t sequence, const Contact& contact, bool too_late) {
    ContactAnswer& made = plan_.answers.emplace_back();
    made = {sequence, contact.id, contact.phase, contact.box, FeltOutcome::driven, motors_at(contact)};
    if (made.actuators.empty()) made.outcome = FeltOutcome::uncovered;
    if (!too_late) return;
    made.outcome = FeltOutcome::stale;
    made.actuators.clear();
  };
  for (const Contact& contact : event.contacts)
    add(event.sequence, contact, false);
  for (const Transition& transition : fresh) {
    if (answered_as_contact(event, transition)) continue;
    const bool over = transition.contact.phase == Phase::down && !holds(event, transition.contact.id);
    add(transition.event_sequence, transition.contact, over && stale(event, transition));
  }
}

// What is down begins, goes on and ends, in the order in which it happened.
void JacketRenderer::feel(const TouchEvent& event, std::span<const Transition> fresh, Timestamp now) {
  for (const Transition& transition : fresh) {
    const Contact& contact = transition.contact;
    if (contact.phase != Phase::down || answered_as_contact(event, transition) || stale(event, transition)) continue;
    if (touching(contact.id) == nullptr) begin(contact, least_of(!holds(event, contact.id)), now);
  }
  for (const Contact& contact : event.contacts) {
    FeltTouch* touch = touching(contact.id);
    if (contact.phase == Phase::up) {
      if (touch != nullptr) touch->lift(contact, now);
    } else if (touch != nullptr) {
      touch->follow(contact, now);
    } else {
      begin(contact, least_of(false), now);
    }
  }
  for (const Transition& transition : fresh) {
    if (transition.contact.phase != Phase::up || holds(event, transition.contact.id)) continue;
    if (FeltTouch* touch = touching(transition.contact.id)) touch->lift(transition.contact, now);
  }
  for (FeltTouch& touch : touches_)
    if (!holds(event, touch.contact().id)) touch.lift(now);
}

void JacketRenderer::begin(const Contact& contact, Duration least, Timestamp now) {
  if (touches_.size() == touches_.capacity()) {
    const auto lifted = std::ranges::find_if(touches_, &FeltTouch::lifted);
    touches_.erase(lifted != touches_.end() ? lifted : touches_.begin());
  }
  touches_.emplace_back(contact, profile_.rendering, least, now);
}

FeltTouch* JacketRenderer::touching(std::uint32_t contact_id) {
  const auto found = std::ranges::find_if(
      touches_, [contact_id](const FeltTouch& touch) { return touch.contact().id == contact_id && !touch.lifted(); });
  return found == touches_.end() ? nullptr : &*found;
}

// For how long a touch is felt at least.
Duration JacketRenderer::least_of(bool late_and_over) const {
  if (profile_.rendering == Rendering::places) return tap_pulse;
  return late_and_over ? drive_duration_ : Duration{};
}

void JacketRenderer::compose(Timestamp now) {
  Wishes wishes{};
  if (now >= vouched_until_) {
    touches_.clear();
    bursts_ = {};
  }
  for (std::size_t index = 0; index < shapers_.size(); ++index)
    if (bursts_[index].end > now) wishes[index] = bursts_[index];
  for (FeltTouch& touch : touches_)
    compose(touch, now, wishes);
  touches_.erase(std::remove_if(touches_.begin(), touches_.end(), [now](const auto& touch) { return touch.over(now); }),
                 touches_.end());
  for (std::size_t index = 0; index < shapers_.size(); ++index)
    shapers_[index].want(wishes[index].strength, wishes[index].end, now);
}

void JacketRenderer::compose(FeltTouch& touch, Timestamp now, Wishes& wishes) {
  const double strength = touch.strength();
  const double level = touch.level(now);
  const bool fast = touch.path().speed_fh_s() * seconds(burst) * bursts_of_slow_stroke > seen_.pitch_fh();
  touch.path().advance(pace_, now, [&](BodyPoint from, BodyPoint to) {
    if (!fast || profile_.rendering == Rendering::boxes) return;
    for (const auto& [index, amplitude] : seen_.passed(from, to)) {
      if (level * amplitude < least_felt) continue;
      Wish& passing = bursts_[index];
      if (passing.end <= now) passing = {};
      passing.add(strength * level * amplitude, std::min(now + burst, vouched_until_));
      wishes[index].add(passing.strength, passing.end);
    }
  });
  if (touch.over(now)) return;
  const Timestamp end = std::min(touch.ends(), vouched_until_);
  for (const auto& [index, amplitude] : spot_of(touch.contact(), touch.path().place()))
    if (level * amplitude >= least_felt) wishes[index].add(strength * level * amplitude, end);
  const double warmth = touch.warmth(now);
  if (warmth <= 0) return;
  for (const auto& [index, nearness] : heaters_near(touch.contact(), profile_))
    wishes[index].add(strength * warmth * nearness, end);
}

// A hug goes around the body; every other touch is where the toucher sees it.
Spot JacketRenderer::spot_of(const Contact& contact, BodyPoint place) const {
  if (profile_.rendering == Rendering::boxes) return motors_of_box(contact, profile_);
  Spot spot = seen_.at(place);
  if (contact.gesture != Gesture::hug || seen_side_ == BodySide::back) return spot;
  for (const SpotShare& share : back_.at(place))
    spot.push_back(share);
  return spot;
}

ActuatorIds JacketRenderer::motors_at(const Contact& contact) const {
  ActuatorIds ids;
  Spot spot = spot_of(contact, contact.body);
  std::ranges::sort(spot, {}, &SpotShare::index);
  for (const auto& [index, amplitude] : spot) {
    const bool felt = amplitude >= least_felt && ids.size() < ids.capacity();
    if (felt) ids.push_back(profile_.actuators[index].id);
  }
  return ids;
}

void JacketRenderer::follow_clock(Timestamp now) {
  if (now < now_) reset();
  now_ = now;
}

}  // namespace telehug
