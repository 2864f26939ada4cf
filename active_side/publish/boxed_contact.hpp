// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/container/static_vector.hpp>
#include <cstdint>

#include "common/messages.hpp"
#include "common/units.hpp"

namespace telehug {

// One contact at one time, with the place on the body that it touches.
struct BoxedContact {
  std::uint32_t id = 0;
  Phase phase = Phase::down;
  ScreenPoint screen;
  double speed_mm_s = 0;
  GridShape grid;         // that `box` is of
  std::uint16_t box = 0;  // 1..columns*rows
  BodyPoint body;
  double strength = 1;
  Gesture gesture = Gesture::none;
};

using BoxedContacts = boost::container::static_vector<BoxedContact, max_contacts>;

}  // namespace telehug
