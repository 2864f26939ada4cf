// SPDX-License-Identifier: Apache-2.0
//
// Logging of the daemons: spdlog's default logger on stderr. Use spdlog::info() and its like after set_up_log().
#pragma once

#include <spdlog/spdlog.h>

#include <optional>
#include <string>
#include <string_view>

namespace telehug {

enum class LogStyle {
  automatic,  // fields if stderr goes to the journal and its socket is there, else journal, terminal or plain
  terminal,   // time of day, coloured level
  plain,      // full date, for a file
  journal,    // "<N>" in front, which the journal reads as the priority; the journal knows the time itself
  fields,     // through the journal's socket, with LogFields
};

// What a message is about, beside its text: fields of the journal, by which `journalctl TELEHUG_PEER=Mia` finds it.
// Elsewhere the text stands alone. common/service/README.md lists stages and messages.
struct LogFields {
  std::string_view stage = {};        // TELEHUG_STAGE; empty: none
  std::string_view peer = {};         // TELEHUG_PEER: what this PC calls it; empty: none
  std::optional<unsigned> contact{};  // TELEHUG_CONTACT
  std::string_view message_id = {};   // MESSAGE_ID, one of message_id; empty: none
};

// Of the few messages that programs may wait for, whatever their words. Never given to another message.
namespace message_id {
inline constexpr std::string_view stopped = "f41ff14e6fd44d3abda048b7276655ea";
inline constexpr std::string_view resumed = "df54fb30e1bb4200b85d6c9b5883e332";
inline constexpr std::string_view configuration_taken = "5f4a6950ba7948dd89f623eae69712fd";
inline constexpr std::string_view configuration_refused = "c06004fafde24498b448f6ba926efc69";
inline constexpr std::string_view peer_connected = "1cce4cdeed9644b2b908349f17eb4d44";
inline constexpr std::string_view peer_absent = "f8fd8f0a749144f0a4959483e31d357e";
inline constexpr std::string_view jacket_ready = "d727be9d93ca4db593c05b9803f056a2";
inline constexpr std::string_view jacket_absent = "a1b6b98987fe4566bdd673abd5b000d2";
inline constexpr std::string_view camera_open = "8048a0810cea439c98b3499c9f6dbf85";
inline constexpr std::string_view camera_lost = "b73271fa40b949c78f787842a2ba7a60";
}  // namespace message_id

// `level`: trace, debug, info, warn or error; anything else is info.
void set_up_log(std::string_view level, LogStyle style = LogStyle::automatic);

// Likewise, from now on.
void set_log_level(std::string_view level);

void log_about(const LogFields& fields, spdlog::level::level_enum level, std::string_view text);

// For a state that is looked at often and changes seldom: logs a text only if it differs from the one before.
class SayOnChange {
 public:
  void say(spdlog::level::level_enum level, std::string_view text, const LogFields& fields = {});
  // The state is over: the next text is said even if it is the same again.
  void forget() { last_.clear(); }

 private:
  std::string last_;
};

}  // namespace telehug
