// SPDX-License-Identifier: Apache-2.0
#include "service/journal_sink.hpp"

#include <fmt/core.h>

#include <boost/container/static_vector.hpp>
#include <cerrno>
#include <cstdio>
#include <string>

namespace telehug {

char journal_priority(spdlog::level::level_enum level) noexcept {
  switch (level) {
    case spdlog::level::critical:
      return '2';
    case spdlog::level::err:
      return '3';
    case spdlog::level::warn:
      return '4';
    case spdlog::level::info:
      return '6';
    default:
      return '7';
  }
}

void JournalSink::sink_it_(const spdlog::details::log_msg& message) {
  boost::container::static_vector<std::string, 10> texts;
  const auto add = [&texts](std::string_view name, std::string_view value) {
    if (!value.empty()) texts.push_back(fmt::format("{}={}", name, value));
  };
  const std::string_view text(message.payload.data(), message.payload.size());
  const char priority = journal_priority(message.level);
  add("MESSAGE", text);
  add("PRIORITY", {&priority, 1});
  // The journal's own guess would be the thread's name.
  add("SYSLOG_IDENTIFIER", program_invocation_short_name);
  if (!message.source.empty()) {
    add("CODE_FILE", message.source.filename);
    add("CODE_LINE", std::to_string(message.source.line));
    add("CODE_FUNC", message.source.funcname);
  }
  if (const LogFields* fields = fields_()) {
    add("MESSAGE_ID", fields->message_id);
    add("TELEHUG_STAGE", fields->stage);
    add("TELEHUG_PEER", fields->peer);
    if (fields->contact) add("TELEHUG_CONTACT", std::to_string(*fields->contact));
  }
  boost::container::static_vector<iovec, 10> parts;
  for (std::string& part : texts)
    parts.push_back({part.data(), part.size()});
  if (send_(parts.data(), static_cast<int>(parts.size())) >= 0) return;
  fmt::print(stderr, "<{}>{}\n", priority, text);
}

}  // namespace telehug
