// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "bench/touch/figure.hpp"
#include "common/units.hpp"

namespace telehug {

// The default detector and model on pictures of a virtual rig in which so many fingers (1 or 5) touch: the whole path
// and, beside it, each stage of the detector called by itself. `suffix` is the end of the figures' names.
Figures measure_default(ImageSize image, int fingers, const std::string& suffix);

}  // namespace telehug
