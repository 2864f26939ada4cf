// SPDX-License-Identifier: Apache-2.0
#include "peer/session_id.hpp"

#include <sys/random.h>

#include <array>
#include <cerrno>
#include <system_error>

namespace telehug {

namespace {
constexpr std::string_view hex_digits = "0123456789abcdef";
}

SessionId new_session_id() {
  std::array<unsigned char, session_id_digits / 2> bytes{};
  // getrandom is never short for up to 256 bytes once the kernel's pool is ready (getrandom(2)).
  if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) {
    throw std::system_error(errno, std::generic_category(), "the kernel gave no random numbers for a session id");
  }
  SessionId id;
  id.reserve(session_id_digits);
  for (const unsigned char byte : bytes) {
    id += hex_digits[byte >> 4U];
    id += hex_digits[byte & 0xFU];
  }
  return id;
}

bool is_session_id(std::string_view text) noexcept {
  return text.size() == session_id_digits && text.find_first_not_of(hex_digits) == std::string_view::npos &&
         text.find_first_not_of('0') != std::string_view::npos;
}

}  // namespace telehug
