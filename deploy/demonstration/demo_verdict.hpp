// SPDX-License-Identifier: Apache-2.0
//
// Did the right thing happen? Pure functions over what was recorded.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "demo_record.hpp"
#include "jacket/jacket_profile.hpp"

namespace telehug {

// Every published touch must be answered as driven, at just the actuators that the profile gives for its box, or at
// some of those about it where touches are felt at their places; their pins must have run while it lasted, and no
// others; in the end every pin must be low. Empty: all is right.
[[nodiscard]] std::vector<std::string> faults(const DemoRecord& record, const JacketProfile& profile);

// Where the finger of a virtual rig really was: nothing if it did not touch in that frame.
using TruthOfFrame = std::function<std::optional<ScreenPoint>(std::uint64_t frame)>;

struct TruthComparison {
  int frames = 0;         // with a published contact
  int without_touch = 0;  // ... in which nobody touched, more than 150 ms from a touch
  double mean_vertical_mm = 0;
  double mean_horizontal_mm = 0;
  double worst_mm = 0;
};
[[nodiscard]] TruthComparison compare_with_truth(const DemoRecord& record, const TruthOfFrame& truth, double fps);

}  // namespace telehug
