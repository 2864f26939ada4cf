// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "eval/failure_pictures.hpp"

namespace telehug {

// The picture with its true and found points marked, and below it what went wrong: a <figure>.
[[nodiscard]] std::string failure_figure(const FailurePicture& picture);

}  // namespace telehug
