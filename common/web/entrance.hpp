// SPDX-License-Identifier: Apache-2.0
//
// Who may see the pages: a link that is valid once and for a minute opens a session, which the browser keeps as a
// cookie.
#pragma once

#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/clock.hpp"

namespace telehug {

inline constexpr std::size_t secret_digits = 64;  // hexadecimal ones: 256 bits

class Entrance {
 public:
  static constexpr Duration link_lasts = 60s;
  static constexpr Duration session_lasts = 12h;    // without a request
  static constexpr std::size_t most_links = 8;      // not yet used; a further one takes the place of the oldest
  static constexpr std::size_t most_sessions = 16;  // a further one takes the place of the one unused for longest

  // Any thread; times of one clock. Both throw std::system_error if the kernel gives no random numbers.

  // The secret of a new link.
  [[nodiscard]] std::string new_link(Timestamp now);
  // Uses a link up: the secret of a new session, or nothing if there is no such link any more.
  [[nodiscard]] std::optional<std::string> enter(std::string_view link, Timestamp now);
  // Is this the secret of a session? If so it goes on.
  [[nodiscard]] bool knows(std::string_view session, Timestamp now);

 private:
  struct Secret {
    std::string text;
    Timestamp until;
  };
  using Secrets = std::vector<Secret>;

  static std::string add(Secrets& secrets, std::size_t most, Timestamp until);
  static Secrets::iterator find(Secrets& secrets, std::string_view text, Timestamp now);

  std::mutex mutex_;
  Secrets links_;     // guarded by mutex_
  Secrets sessions_;  // likewise
};

}  // namespace telehug
