// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "jacket/jacket_profile.hpp"

namespace telehug {

inline constexpr int body_picture_columns = 58;
inline constexpr int body_picture_lines = 15;

// The wearer as the toucher sees them, drawn in text: one string a line (UTF-8, at most body_picture_columns
// characters, no colour codes), every actuator of that side of the body at its place with its id; a filled circle
// marks those in `running`.
[[nodiscard]] std::vector<std::string> body_picture(const JacketProfile& profile, std::span<const std::uint8_t> running,
                                                    BodySide side = BodySide::front);

}  // namespace telehug
