// SPDX-License-Identifier: Apache-2.0
#include "service/journal_sink.hpp"

#include <fmt/core.h>

#include <boost/container/static_vector.hpp>
#include <cerrno>
#include <condition_variable>
#include <cstdio>
#include <deque>
#include <string>
#include <utility>

namespace telehug {
namespace {

constexpr std::size_t most_fields = 10;

struct Entry {
  boost::container::static_vector<std::string, most_fields> fields;
  std::string on_stderr;
};

void send_or_print(JournalSink::Send send, Entry& entry) {
  boost::container::static_vector<iovec, most_fields> parts;
  for (std::string& field : entry.fields)
    parts.push_back({field.data(), field.size()});
  if (send(parts.data(), static_cast<int>(parts.size())) < 0) fmt::print(stderr, "{}\n", entry.on_stderr);
}

Entry note_of_lost(std::uint64_t lost) {
  const std::string text = fmt::format("{} messages were left out: the journal did not take them in time", lost);
  return {{"MESSAGE=" + text, "PRIORITY=4", std::string("SYSLOG_IDENTIFIER=") + program_invocation_short_name},
          "<4>" + text};
}

}  // namespace

struct JournalSink::Queue {
  explicit Queue(Send its_send) : send(its_send) {}

  const Send send;
  std::mutex mutex;  // guards what follows; never held while sending
  std::condition_variable changed;
  std::deque<Entry> waiting;
  std::uint64_t lost = 0;
  bool ending = false;
  bool ended = false;

  void run() {
    std::unique_lock lock(mutex);
    while (true) {
      changed.wait(lock, [this] { return ending || !waiting.empty(); });
      if (waiting.empty()) break;
      Entry entry = std::move(waiting.front());
      waiting.pop_front();
      const std::uint64_t left_out = waiting.empty() ? std::exchange(lost, 0) : 0;
      lock.unlock();
      send_or_print(send, entry);
      if (left_out > 0) {
        Entry note = note_of_lost(left_out);
        send_or_print(send, note);
      }
      lock.lock();
    }
    ended = true;
    changed.notify_all();
  }
};

JournalSink::JournalSink(Send send, Fields fields)
    : fields_(fields), queue_(std::make_shared<Queue>(send)), thread_([queue = queue_] { queue->run(); }) {}

JournalSink::~JournalSink() {
  bool ended = false;
  {
    std::unique_lock lock(queue_->mutex);
    queue_->ending = true;
    queue_->changed.notify_all();
    ended = queue_->changed.wait_for(lock, longest_end, [this] { return queue_->ended; });
  }
  ended ? thread_.join() : thread_.detach();
}

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
  Entry entry;
  const auto add = [&entry](std::string_view name, std::string_view value) {
    if (!value.empty()) entry.fields.push_back(fmt::format("{}={}", name, value));
  };
  const std::string_view text(message.payload.data(), message.payload.size());
  const char priority = journal_priority(message.level);
  entry.on_stderr = fmt::format("<{}>{}", priority, text);
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
  {
    const std::lock_guard lock(queue_->mutex);
    if (queue_->waiting.size() >= most_waiting) {
      ++queue_->lost;
      return;
    }
    queue_->waiting.push_back(std::move(entry));
  }
  queue_->changed.notify_one();
}

}  // namespace telehug
