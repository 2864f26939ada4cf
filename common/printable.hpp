// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/locale/utf.hpp>
#include <string_view>

namespace telehug {

// UTF-8 without control characters, neither of ASCII nor of ISO 8859: what may go to terminals, logs, JSON and web
// pages as it is.
[[nodiscard]] inline bool printable(std::string_view text) {
  using Utf8 = boost::locale::utf::utf_traits<char>;
  for (const char* at = text.begin(); at != text.end();) {
    const auto code_point = Utf8::decode(at, text.end());
    if (!boost::locale::utf::is_valid_codepoint(code_point)) return false;
    const bool control = code_point < 0x20 || (code_point >= 0x7F && code_point < 0xA0);
    if (control) return false;
  }
  return true;
}

}  // namespace telehug
