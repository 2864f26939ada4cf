// SPDX-License-Identifier: Apache-2.0
//
// From touches to what the jacket shall do: which actuators, how strong, until when. How strong that may get and
// whether anything happens at all is the safety stage's business.
#pragma once

#include <boost/container/static_vector.hpp>
#include <span>

#include "common/clock.hpp"
#include "common/messages.hpp"
#include "jacket/drive.hpp"
#include "jacket/jacket_profile.hpp"

namespace telehug {

// A tap that is delivered later than this after it happened is not felt any more: after about 300 ms the wearer no
// longer takes seen and felt touch for one (Shimada 2009).
inline constexpr Duration oldest_tap = 500ms;

using ActuatorIds = boost::container::static_vector<std::uint8_t, max_felt_actuators>;

// What becomes of one contact, or of one transition that was lost and came later.
struct ContactAnswer {
  std::uint64_t touch_sequence = 0;  // of the event in which it was new
  std::uint32_t contact_id = 0;
  Phase phase = Phase::down;
  std::uint16_t box = 0;
  FeltOutcome outcome = FeltOutcome::driven;  // driven, uncovered or stale; the safety stage may turn driven down
  ActuatorIds actuators;                      // for `up`: those of the place where it ended
};

struct JacketPlan {
  Drives drives;  // at most one an actuator, in the profile's order; strength 0: this one ends now
  Drives pulses;  // of taps that came late and may still run; remembered so that the next event does not end them
  boost::container::static_vector<ContactAnswer, max_contacts + max_transitions> answers;
};

// The actuators that a touch is felt at: those that serve its box; failing that, by the profile's rule. A grid of
// another shape than the standard one, and a box outside it, is read through the position on the body.
[[nodiscard]] ActuatorIds actuators_at(const Contact& contact, const JacketProfile& profile);

// `fresh`: those of the event's transitions that no event before has delivered. `before`: the plan made last, or {}.
// Every contact that is down drives its actuators for `drive_duration` (renewed by each event); several on one
// actuator give the strongest, not the sum. What no contact holds any more ends now. A tap of which only the fresh
// transitions tell is one pulse of `drive_duration`. Allocates nothing.
[[nodiscard]] JacketPlan touch_to_drives(const TouchEvent& event, std::span<const Transition> fresh,
                                         const JacketProfile& profile, const JacketPlan& before, Timestamp now,
                                         Duration drive_duration);

}  // namespace telehug
