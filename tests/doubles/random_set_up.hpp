// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "common/units.hpp"

namespace telehug {

struct SetUpTrial {
  bool quick = false;     // two dots
  double turned_deg = 0;  // the camera, from where it should look: > 0 towards the user
  bool trace = false;     // print what the session says, as it says it
  std::string pictures;   // folder for the last picture if it is not good; empty: none
};

enum class SetUpEnd {
  good,     // could be saved, and is right
  wrong,    // could be saved, and is not
  refused,  // solved, but not good enough to be saved
  stuck,    // in a step, within the time
};

struct SetUpOutcome {
  std::uint64_t seed = 0;
  SetUpEnd end = SetUpEnd::stuck;
  double seconds = 0;                 // simulated
  std::size_t dots_used = 0;          // that the calibration rests on
  int repeated = 0;                   // dots that were asked for again
  int lifted = 0;                     // fingers that were lifted and laid down again, as nothing had happened
  std::optional<ScreenPoint> errors;  // mean over all places that the camera sees, mm
  std::string said;                   // where it stood last, the advice, and faults

  [[nodiscard]] const char* name() const noexcept;
};

// random_rig(seed), whose first user sets it up: goes away, lays a finger on each dot in a pose of its own, lifts it
// and tries again if nothing happens, leaves out a dot that does not want to be touched, repeats those that are asked
// for.
[[nodiscard]] SetUpOutcome set_up_random_rig(std::uint64_t seed, const SetUpTrial& trial);

}  // namespace telehug
