// SPDX-License-Identifier: Apache-2.0
#include "service/log.hpp"

#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <sys/stat.h>
#include <systemd/sd-journal.h>
#include <unistd.h>

#include <cstdlib>
#include <memory>

#include "service/journal_sink.hpp"

namespace telehug {
namespace {

// Where journald listens (sd_journal_send(3)).
constexpr const char* journal_socket = "/run/systemd/journal/socket";

thread_local const LogFields* fields_of_this_thread = nullptr;

class PriorityFlag final : public spdlog::custom_flag_formatter {
 public:
  void format(const spdlog::details::log_msg& message, const std::tm&, spdlog::memory_buf_t& out) override {
    out.push_back('<');
    out.push_back(journal_priority(message.level));
    out.push_back('>');
  }
  [[nodiscard]] std::unique_ptr<custom_flag_formatter> clone() const override {
    return std::make_unique<PriorityFlag>();
  }
};

// systemd.exec(5): $JOURNAL_STREAM holds "device:inode" of the stream to the journal. A shell started from a unit
// inherits it, so it must be compared with what stderr really is.
bool stderr_is_the_journal() {
  const char* text = std::getenv("JOURNAL_STREAM");
  struct stat status {};
  if (text == nullptr || fstat(STDERR_FILENO, &status) != 0) return false;
  return std::string_view(text) == std::to_string(status.st_dev) + ":" + std::to_string(status.st_ino);
}

LogStyle style_of_stderr() {
  if (stderr_is_the_journal()) return access(journal_socket, W_OK) == 0 ? LogStyle::fields : LogStyle::journal;
  return isatty(STDERR_FILENO) == 1 ? LogStyle::terminal : LogStyle::plain;
}

}  // namespace

void set_up_log(std::string_view level, LogStyle style) {
  if (style == LogStyle::automatic) style = style_of_stderr();
  std::shared_ptr<spdlog::sinks::sink> sink;
  auto formatter = std::make_unique<spdlog::pattern_formatter>();
  if (style == LogStyle::fields) {
    sink = std::make_shared<JournalSink>(sd_journal_sendv, [] { return fields_of_this_thread; });
  } else if (style == LogStyle::terminal) {
    sink = std::make_shared<spdlog::sinks::stderr_color_sink_mt>();
    formatter->set_pattern("%H:%M:%S.%e %^%-7l%$ %v");
  } else {
    sink = std::make_shared<spdlog::sinks::stderr_sink_mt>();
    if (style == LogStyle::journal) {
      formatter->add_flag<PriorityFlag>('*').set_pattern("%*%v");
    } else {
      formatter->set_pattern("%Y-%m-%dT%H:%M:%S.%e%z %-7l %v");
    }
  }
  sink->set_formatter(std::move(formatter));
  auto logger = std::make_shared<spdlog::logger>("telehug", std::move(sink));
  logger->flush_on(spdlog::level::trace);
  spdlog::set_default_logger(std::move(logger));
  set_log_level(level);
}

void set_log_level(std::string_view level) {
  const auto known = spdlog::level::from_str(std::string(level));
  // from_str() gives "off" for what it does not know.
  spdlog::set_level(known == spdlog::level::off ? spdlog::level::info : known);
}

void log_about(const LogFields& fields, spdlog::level::level_enum level, std::string_view text) {
  // The sink is called before log() returns, on this thread.
  fields_of_this_thread = &fields;
  spdlog::log(level, "{}", text);
  fields_of_this_thread = nullptr;
}

void SayOnChange::say(spdlog::level::level_enum level, std::string_view text, const LogFields& fields) {
  if (text == last_) return;
  last_ = text;
  log_about(fields, level, text);
}

}  // namespace telehug
