// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "bench/touch/figure.hpp"

namespace telehug {

// A table; and, if `json_file` is not empty, that file: {"figure name": {"p50":, "p99":, "unit":}}. Throws
// std::runtime_error if it can't be written.
void print_and_write(const Figures& figures, const std::string& json_file);

}  // namespace telehug
