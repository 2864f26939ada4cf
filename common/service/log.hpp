// SPDX-License-Identifier: Apache-2.0
//
// Logging of the daemons: spdlog's default logger on stderr. Use spdlog::info() and its like after set_up_log().
#pragma once

#include <spdlog/spdlog.h>

#include <string>
#include <string_view>

namespace telehug {

enum class LogStyle {
  automatic,  // journal if stderr goes there, else terminal or plain
  terminal,   // time of day, coloured level
  plain,      // full date, for a file
  journal,    // "<N>" in front, which the journal reads as the priority; the journal knows the time itself
};

// `level`: trace, debug, info, warn or error; anything else is info.
void set_up_log(std::string_view level, LogStyle style = LogStyle::automatic);

// Likewise, from now on.
void set_log_level(std::string_view level);

// For a state that is looked at often and changes seldom: logs a text only if it differs from the one before.
class SayOnChange {
 public:
  void say(spdlog::level::level_enum level, std::string_view text);
  // The state is over: the next text is said even if it is the same again.
  void forget() { last_.clear(); }

 private:
  std::string last_;
};

}  // namespace telehug
