// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string_view>

#include "common/messages.hpp"

namespace telehug {

inline constexpr std::size_t session_id_digits = 32;

// 128 random bits of the kernel, as 32 lower-case hexadecimal digits. Throws std::system_error if the kernel has none.
[[nodiscard]] SessionId new_session_id();

// 32 lower-case hexadecimal digits, not all of them zero.
[[nodiscard]] bool is_session_id(std::string_view text) noexcept;

}  // namespace telehug
