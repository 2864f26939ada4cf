// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "common/clock.hpp"

namespace telehug {

// What of Fast DDS's own messages is told: it repeats some for every packet, tens of times a second while a peer comes
// or goes. Of each kind (by the place in Fast DDS that says it) the first is told, and then one in ten minutes.
class LibraryLog {
 public:
  static constexpr Duration quiet_time = 10min;
  static constexpr std::size_t most_kinds = 64;  // all others are one kind

  // The sentence to tell, or nothing.
  std::optional<std::string> heard(std::string_view place, std::string_view message, Timestamp now);

 private:
  struct Kind {
    Timestamp told;
    unsigned untold = 0;
  };
  std::map<std::string, Kind, std::less<>> kinds_;
};

// From now on Fast DDS writes nothing to the standard error; `tell` is called in a thread of its own, one call at a
// time.
void tell_library_log(std::function<void(const std::string&)> tell);

}  // namespace telehug
