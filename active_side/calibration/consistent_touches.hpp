// SPDX-License-Identifier: Apache-2.0
//
// Which of the touches of a calibration one camera can have seen: a dot that is no dot, or a finger that is elsewhere,
// contradicts the others.
#pragma once

#include <cstddef>
#include <vector>

#include "calibration/rig_observations.hpp"

namespace telehug {

// The indices of the largest set of touches that one camera can have seen, rising; all if they are fewer than four,
// since three touches contradict no others clearly. Random sample consensus (Fischler and Bolles, 1981) over all
// triples. Neither the border nor what was left out before matters. Empty if there is no solution at all.
[[nodiscard]] std::vector<std::size_t> consistent_touches(const RigObservations& seen);

}  // namespace telehug
