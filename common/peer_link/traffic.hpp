// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <mutex>
#include <optional>
#include <utility>

#include "dds/participant.hpp"
#include "dds/reader.hpp"
#include "dds/writer.hpp"

namespace telehug {

// What a pipeline says and hears beside PeerLink's words, while the participant under it may be replaced.
template <typename Out, typename In>
class Traffic {
 public:
  // `hear` as a Reader's callback.
  explicit Traffic(typename Reader<In>::Callback hear) : hear_(std::move(hear)) {}

  // --- pipeline's thread ---

  // False as well while the participant is being replaced: nobody waits for that here.
  bool write(const Out& message) noexcept {
    const std::unique_lock lock(sending_, std::try_to_lock);
    return lock.owns_lock() && ends_ && ends_->writer.write(message);
  }

  // --- housekeeping thread ---

  void disconnect() {
    const std::scoped_lock locks(counting_, sending_);
    if (!ends_) return;
    dropped_before_ += ends_->dropped();
    ends_.reset();
  }
  // Throws as Reader and Writer do, and is disconnected then.
  void connect(DdsParticipant& participant) {
    disconnect();
    const std::scoped_lock locks(counting_, sending_);
    ends_.emplace(participant, hear_);
  }

  // --- any other thread ---

  // Messages that were malformed or out of range.
  [[nodiscard]] std::uint64_t dropped() const {
    const std::lock_guard lock(counting_);
    return dropped_before_ + (ends_ ? ends_->dropped() : 0);
  }

 private:
  struct Ends {
    Ends(DdsParticipant& participant, typename Reader<In>::Callback hear)
        : writer(participant), reader(participant, std::move(hear)) {}
    [[nodiscard]] std::uint64_t dropped() const noexcept {
      const ReaderCounters counters = reader.counters();
      return counters.malformed + counters.invalid;
    }
    Writer<Out> writer;
    Reader<In> reader;
  };

  typename Reader<In>::Callback hear_;
  std::mutex sending_;  // as in PeerLink: the pipeline only tries it, and only housekeeping takes it beside
  mutable std::mutex counting_;
  std::uint64_t dropped_before_ = 0;
  std::optional<Ends> ends_;
};

}  // namespace telehug
