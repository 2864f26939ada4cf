// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/container/static_vector.hpp>
#include <cstdint>

#include "common/messages.hpp"
#include "jacket/drive.hpp"

namespace telehug {

using ActuatorIds = boost::container::static_vector<std::uint8_t, max_felt_actuators>;

// What becomes of one contact, or of one transition that was lost and came later.
struct ContactAnswer {
  std::uint64_t touch_sequence = 0;  // of the event in which it was new
  std::uint32_t contact_id = 0;
  Phase phase = Phase::down;
  std::uint16_t box = 0;
  FeltOutcome outcome = FeltOutcome::driven;  // driven, uncovered or stale; the safety stage may turn driven down
  ActuatorIds actuators;                      // motors of its place; for `up`: of the place where it ended
};

struct JacketPlan {
  Drives drives;  // at most one an actuator, in the profile's order; strength 0: this one ends now
  boost::container::static_vector<ContactAnswer, max_contacts + max_transitions> answers;
};

}  // namespace telehug
