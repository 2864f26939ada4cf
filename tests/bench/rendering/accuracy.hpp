// SPDX-License-Identifier: Apache-2.0
//
// How exactly a jacket lets touches be felt where they are: a grid of touches goes through the stages, and the centre
// of what the motors then do is compared with the touch.
#pragma once

#include <optional>
#include <vector>

#include "common/units.hpp"
#include "jacket/jacket_profile.hpp"

namespace telehug {

struct FeltPlace {
  BodyPoint touch;
  bool between_motors = false;            // inside of the hull of all motors of the front
  std::optional<BodyPoint> felt;          // centre of the motors' energies; nothing: nowhere
  [[nodiscard]] double error_fh() const;  // of one that is felt
};

// What the centre is taken of.
enum class Seen {
  drives,  // what the renderer asks for
  steps,   // the steps of power that the microcontroller then makes
};

// Of touches every `step_fh` all over the standard grid's first four rows: collar to hips, arm to arm.
[[nodiscard]] std::vector<FeltPlace> measure_accuracy(const JacketProfile& profile, Seen seen, double step_fh = 0.125);

struct AccuracySummary {
  std::size_t touches = 0;
  std::size_t uncovered = 0;
  double mean_fh = 0, median_fh = 0, p99_fh = 0, most_fh = 0;  // of those that are felt; 0 if none is
};

[[nodiscard]] AccuracySummary summarise(const std::vector<FeltPlace>& places, bool between_motors_only);

}  // namespace telehug
