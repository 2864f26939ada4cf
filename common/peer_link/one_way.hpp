// SPDX-License-Identifier: Apache-2.0
//
// What goes in one direction only, while the participant under it may be replaced. Beside Traffic, whose pipeline must
// not wait: here whoever sends waits for a participant that is just being made.
#pragma once

#include <cstdint>
#include <mutex>
#include <optional>
#include <utility>

#include "dds/participant.hpp"
#include "dds/reader.hpp"
#include "dds/writer.hpp"

namespace telehug {

template <typename T>
class Outgoing {
 public:
  // Any thread. False: there is nobody who could read it.
  bool write(const T& message) {
    const std::lock_guard lock(mutex_);
    return writer_ && writer_->matched() > 0 && writer_->write(message);
  }

  // --- housekeeping thread ---

  void disconnect() {
    const std::lock_guard lock(mutex_);
    writer_.reset();
  }
  void connect(DdsParticipant& participant) {  // throws as Writer does, and is disconnected then
    const std::lock_guard lock(mutex_);
    writer_.reset();
    writer_.emplace(participant);
  }

 private:
  std::mutex mutex_;
  std::optional<Writer<T>> writer_;
};

template <typename T>
class Incoming {
 public:
  // `hear` as a Reader's callback.
  explicit Incoming(typename Reader<T>::Callback hear) : hear_(std::move(hear)) {}

  // Any thread: messages that were malformed or out of range.
  [[nodiscard]] std::uint64_t dropped() const {
    const std::lock_guard lock(mutex_);
    return dropped_before_ + dropped_by_this_one();
  }

  // --- housekeeping thread ---

  void disconnect() {
    const std::lock_guard lock(mutex_);
    dropped_before_ += dropped_by_this_one();
    reader_.reset();
  }
  void connect(DdsParticipant& participant) {  // throws as Reader does, and is disconnected then
    disconnect();
    const std::lock_guard lock(mutex_);
    reader_.emplace(participant, hear_);
  }

 private:
  [[nodiscard]] std::uint64_t dropped_by_this_one() const {
    if (!reader_) return 0;
    const ReaderCounters counters = reader_->counters();
    return counters.malformed + counters.invalid;
  }

  typename Reader<T>::Callback hear_;
  mutable std::mutex mutex_;
  std::uint64_t dropped_before_ = 0;
  std::optional<Reader<T>> reader_;
};

}  // namespace telehug
