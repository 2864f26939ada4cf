// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "ctl/config_choice.hpp"

namespace telehug {

// The whole report; asks daemons, programs and the journal, which takes some seconds.
[[nodiscard]] std::string make_report(const ConfigChoice& choice);

// Its first lines: what it holds and what not.
[[nodiscard]] std::string report_contents();

}  // namespace telehug
