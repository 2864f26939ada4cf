// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "bench/touch/figure.hpp"

namespace telehug {

// The thesis' algorithm on the sequence of a recording, with and without its continuity over frames, and the part of
// it that cuts and filters.
Figures measure_thesis(const std::filesystem::path& recording);

}  // namespace telehug
