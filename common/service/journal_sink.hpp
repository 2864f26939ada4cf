// SPDX-License-Identifier: Apache-2.0
//
// spdlog's way to the journal with fields (sd_journal_sendv(3)); for log.cpp alone.
#pragma once

#include <spdlog/sinks/base_sink.h>
#include <sys/uio.h>

#include <memory>
#include <mutex>
#include <thread>

#include "common/clock.hpp"
#include "service/log.hpp"

namespace telehug {

// The priorities of sd-daemon(3).
[[nodiscard]] char journal_priority(spdlog::level::level_enum level) noexcept;

// Sends from a thread of its own: who logs never waits for a journal that hangs.
class JournalSink final : public spdlog::sinks::base_sink<std::mutex> {
 public:
  // As sd_journal_sendv(): negative if it can't be sent.
  using Send = int (*)(const iovec* fields, int count);

  // Of the thread that logs, while it does; null: none.
  using Fields = const LogFields* (*)();

  static constexpr std::size_t most_waiting = 1000;  // messages; while so many wait, more are counted and left out
  static constexpr Duration longest_end = std::chrono::seconds(1);

  JournalSink(Send send, Fields fields);
  // Waits until all is sent, but not for longer than that.
  ~JournalSink() override;
  JournalSink(const JournalSink&) = delete;
  JournalSink& operator=(const JournalSink&) = delete;

 private:
  struct Queue;

  // What the journal does not take goes to stderr, with its priority in front.
  void sink_it_(const spdlog::details::log_msg& message) override;
  void flush_() override {}

  const Fields fields_;
  const std::shared_ptr<Queue> queue_;  // outlives this where its thread hangs
  std::thread thread_;
};

}  // namespace telehug
