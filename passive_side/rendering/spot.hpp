// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/container/static_vector.hpp>
#include <cstddef>

#include "jacket/drive.hpp"

namespace telehug {

// What one actuator has of a touch.
struct SpotShare {
  std::size_t index = 0;  // in the profile's `actuators`
  double amplitude = 0;   // above 0, up to 1: of the touch's strength
};

// Where a touch is felt; each actuator at most once.
using Spot = boost::container::static_vector<SpotShare, max_actuators>;

}  // namespace telehug
