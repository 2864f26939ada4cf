// SPDX-License-Identifier: Apache-2.0
//
// Which of the touches of a calibration one camera can have seen: a dot that is no dot, or a finger that is elsewhere,
// contradicts the others.
#pragma once

#include <cstddef>
#include <vector>

#include "calibration/rig_observations.hpp"

namespace telehug {

// The indices of the largest set of touches that one camera can have seen, rising. Five marks and more tell the camera
// by themselves; else it is random sample consensus (Fischler and Bolles, 1981) over all triples of touches, and all of
// these if they are fewer than four, since three touches contradict no others clearly. Neither the border nor what was
// left out before matters. Empty if there is no solution at all.
[[nodiscard]] std::vector<std::size_t> consistent_touches(const RigObservations& seen);

}  // namespace telehug
