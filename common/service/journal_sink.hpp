// SPDX-License-Identifier: Apache-2.0
//
// spdlog's way to the journal with fields (sd_journal_sendv(3)); for log.cpp alone.
#pragma once

#include <spdlog/sinks/base_sink.h>
#include <sys/uio.h>

#include <mutex>

#include "service/log.hpp"

namespace telehug {

// The priorities of sd-daemon(3).
[[nodiscard]] char journal_priority(spdlog::level::level_enum level) noexcept;

class JournalSink final : public spdlog::sinks::base_sink<std::mutex> {
 public:
  // As sd_journal_sendv(): negative if it can't be sent.
  using Send = int (*)(const iovec* fields, int count);

  // Of the thread that logs, while it does; null: none.
  using Fields = const LogFields* (*)();

  JournalSink(Send send, Fields fields) : send_(send), fields_(fields) {}

 private:
  // What the journal does not take goes to stderr, with its priority in front.
  void sink_it_(const spdlog::details::log_msg& message) override;
  void flush_() override {}

  const Send send_;
  const Fields fields_;
};

}  // namespace telehug
