// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/container/static_vector.hpp>
#include <cstdint>

#include "common/clock.hpp"
#include "common/messages.hpp"
#include "common/units.hpp"

namespace telehug {

// One touch point of one frame, before it has an identity.
using ScreenPoints = boost::container::static_vector<ScreenPoint, max_contacts>;

// One finger on the screen over time. A contact is reported once with `down`, then `move` every frame, once with `up`
// (at its last place).
struct ContactState {
  std::uint32_t id = 0;
  Phase phase = Phase::down;
  ScreenPoint screen;
  double speed_mm_s = 0;
  Timestamp frame_time;  // of the frame in which this was seen
  double touching = 1;   // the probability that it still touches in the present frame; low while its end is uncertain
  Gesture gesture = Gesture::none;  // so far; with `up`, what it was
};

using ContactStates = boost::container::static_vector<ContactState, max_contacts>;

}  // namespace telehug
