// SPDX-License-Identifier: Apache-2.0
#include "jacket/touch_to_drives.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace telehug {
namespace {

bool finite(BodyPoint point) {
  return std::isfinite(point.x_fh) && std::isfinite(point.y_fh);
}

// Number in the standard grid; 0: beside or above it, or nowhere.
int standard_box(const Contact& contact) {
  if (contact.grid.columns == standard_columns && contact.box >= 1 &&
      contact.box <= contact.grid.columns * contact.grid.rows) {
    return contact.box;
  }
  if (!finite(contact.body)) return 0;
  const double column = std::floor(contact.body.x_fh / standard_box_side_fh + standard_columns / 2.0);
  const double row = std::floor(contact.body.y_fh / standard_box_side_fh);
  const bool inside = column >= 0 && column < standard_columns && row >= 0 && row < standard_rows;
  return inside ? static_cast<int>(row) * standard_columns + static_cast<int>(column) + 1 : 0;
}

const Actuator* nearest_actuator(BodyPoint to, const JacketProfile& profile) {
  if (!finite(to) || profile.actuators.empty()) return nullptr;
  return &*std::ranges::min_element(profile.actuators, {}, [to](const Actuator& actuator) {
    return std::hypot(actuator.place.x_fh - to.x_fh, actuator.place.y_fh - to.y_fh);
  });
}

// Strength and end of every actuator while a plan is made, in the profile's order.
class Demand {
 public:
  explicit Demand(const JacketProfile& profile) : profile_(profile) {}

  void add(std::uint8_t actuator, double strength, Timestamp end) {
    const auto index = profile_.index_of(actuator);
    if (!index || *index >= max_actuators) return;
    std::optional<Drive>& drive = drives_[*index];
    if (!drive) drive = Drive{actuator, strength, end};
    drive->strength = std::max(drive->strength, strength);
    drive->end = std::max(drive->end, end);
  }

  [[nodiscard]] bool has(std::uint8_t actuator) const {
    const auto index = profile_.index_of(actuator);
    return index && *index < max_actuators && drives_[*index];
  }

  [[nodiscard]] Drives drives() const {
    Drives all;
    for (const auto& drive : drives_) {
      if (drive) all.push_back(*drive);
    }
    return all;
  }

 private:
  const JacketProfile& profile_;
  std::array<std::optional<Drive>, max_actuators> drives_{};
};

// A strength that is no number stays one: std::max would hide it behind another contact's.
double known_strength(const Contact& contact) {
  return std::isfinite(contact.strength) ? contact.strength : 0;
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

ContactAnswer answer(std::uint64_t sequence, const Contact& contact, const JacketProfile& profile) {
  ContactAnswer made{sequence,    contact.id,          contact.phase,
                     contact.box, FeltOutcome::driven, actuators_at(contact, profile)};
  if (made.actuators.empty()) made.outcome = FeltOutcome::uncovered;
  return made;
}

void hold_contacts(const TouchEvent& event, const JacketProfile& profile, Timestamp end, Demand& demand,
                   JacketPlan& plan) {
  for (const Contact& contact : event.contacts) {
    plan.answers.push_back(answer(event.sequence, contact, profile));
    if (contact.phase == Phase::up) continue;
    for (const std::uint8_t actuator : plan.answers.back().actuators)
      demand.add(actuator, known_strength(contact), end);
  }
}

void pulse_late_taps(const TouchEvent& event, std::span<const Transition> fresh, const JacketProfile& profile,
                     Timestamp end, Demand& demand, JacketPlan& plan) {
  Demand pulses(profile);
  for (const Transition& transition : fresh.first(std::min(fresh.size(), max_transitions))) {
    if (answered_as_contact(event, transition)) continue;
    const Contact& contact = transition.contact;
    plan.answers.push_back(answer(transition.event_sequence, contact, profile));
    ContactAnswer& made = plan.answers.back();
    if (contact.phase != Phase::down || holds(event, contact.id)) continue;
    if (stale(event, transition)) {
      made.outcome = FeltOutcome::stale;
      made.actuators.clear();
    }
    for (const std::uint8_t actuator : made.actuators) {
      demand.add(actuator, known_strength(contact), end);
      pulses.add(actuator, known_strength(contact), end);
    }
  }
  plan.pulses = pulses.drives();
}

bool contains(const Drives& drives, std::uint8_t actuator) {
  return std::ranges::find(drives, actuator, &Drive::actuator) != drives.end();
}

}  // namespace

ActuatorIds actuators_at(const Contact& contact, const JacketProfile& profile) {
  ActuatorIds found;
  const int box = standard_box(contact);
  for (const Actuator& actuator : profile.actuators) {
    const bool serves = std::ranges::find(actuator.boxes, box) != actuator.boxes.end();
    if (serves && found.size() < found.capacity()) found.push_back(actuator.id);
  }
  if (!found.empty() || profile.uncovered == Uncovered::none) return found;
  if (const Actuator* nearest = nearest_actuator(contact.body, profile)) found.push_back(nearest->id);
  return found;
}

JacketPlan touch_to_drives(const TouchEvent& event, std::span<const Transition> fresh, const JacketProfile& profile,
                           const JacketPlan& before, Timestamp now, Duration drive_duration) {
  JacketPlan plan;
  Demand demand(profile);
  const Timestamp end = now + drive_duration;
  hold_contacts(event, profile, end, demand, plan);
  pulse_late_taps(event, fresh, profile, end, demand, plan);

  for (const Drive& pulse : before.pulses) {
    // An end beyond what this plan would give was made by a clock that has jumped back since.
    const bool runs = pulse.end > now && pulse.end <= end;
    if (runs && !contains(plan.pulses, pulse.actuator)) plan.pulses.push_back(pulse);
    if (runs && demand.has(pulse.actuator)) demand.add(pulse.actuator, pulse.strength, pulse.end);
  }
  for (const Drive& drive : before.drives) {
    if (drive.strength > 0 && !contains(plan.pulses, drive.actuator)) demand.add(drive.actuator, 0, now);
  }
  plan.drives = demand.drives();
  return plan;
}

}  // namespace telehug
