// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/types.hpp>
#include <optional>
#include <string_view>

#include "common/result.hpp"

namespace telehug {

// What of a picture of `size` px is to be looked at: `wanted`, cut to the picture; all of it if nothing is wanted.
// Fails if nothing is left. `picture` names it in the error: "the picture chat.png".
Result<cv::Rect> watched_part(const std::optional<cv::Rect>& wanted, cv::Size size, std::string_view picture);

}  // namespace telehug
