// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "common/messages.hpp"
#include "dds/participant.hpp"

namespace telehug {

struct ReaderCounters {
  std::uint64_t received = 0;        // handed to the callback
  std::uint64_t malformed = 0;       // dropped: not to be decoded
  std::uint64_t invalid = 0;         // dropped: decoded, but out of range (validate.hpp)
  const char* last_fault = nullptr;  // what was wrong with the last invalid one; a literal; null: nothing yet
};

// Subscribes to T: TouchEvent, Felt, Heartbeat, SideStatus, StopAll, PairRenewal or Hug.
template <typename T>
class Reader {
 public:
  // Called on a thread of DDS with each message that is valid, one at a time; the message lives as long as the call. It
  // must only hand over (LatestSlot and the like), must not throw, and must not destroy this reader.
  using Callback = std::function<void(const T&)>;

  // Throws DdsError with a sentence. Messages may come in before this returns.
  Reader(DdsParticipant& participant, Callback callback);
  // After this the callback is not called any more.
  ~Reader();
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  [[nodiscard]] ReaderCounters counters() const noexcept;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

extern template class Reader<TouchEvent>;
extern template class Reader<Felt>;
extern template class Reader<Heartbeat>;
extern template class Reader<SideStatus>;
extern template class Reader<StopAll>;
extern template class Reader<PairRenewal>;
extern template class Reader<Hug>;

}  // namespace telehug
