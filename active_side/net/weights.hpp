// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace telehug {

// The trained nets' files, which are part of the program (see tensors.hpp).
std::string_view overview_weights();
std::string_view tip_weights();

}  // namespace telehug
