// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/container/static_vector.hpp>
#include <cstdint>

#include "common/clock.hpp"
#include "common/messages.hpp"

namespace telehug {

inline constexpr std::size_t max_actuators = 32;

// One actuator, how strong, and until when. There is no drive without an end time.
struct Drive {
  std::uint8_t actuator = 0;  // id of the jacket profile
  double strength = 0;        // 0..1 of what the profile allows this actuator
  Timestamp end;
};

using Drives = boost::container::static_vector<Drive, max_actuators>;

}  // namespace telehug
