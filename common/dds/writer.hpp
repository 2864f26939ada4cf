// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "common/clock.hpp"
#include "common/messages.hpp"
#include "dds/participant.hpp"

namespace telehug {

// Publishes T: TouchEvent, Felt, Heartbeat, SideStatus, StopAll, PairRenewal or Hug (topics and QoS: idl/README.md).
template <typename T>
class Writer {
 public:
  // Throws DdsError with a sentence.
  explicit Writer(DdsParticipant& participant);
  ~Writer();
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  // Sends from the calling thread, without a queue. False: the message is not valid (see validate.hpp) or DDS refused
  // it. Texts that are too long for the wire (reason: 255 bytes, version: 32) are cut. One thread at a time.
  bool write(const T& message) noexcept;

  // Readers that this writer is matched with. A reader that was killed stays matched for minutes (the lease is long,
  // see qos.hpp): whether the peer lives is for PeerMonitor to say.
  [[nodiscard]] int matched() const noexcept;

  // Of a reliable topic: waits until all readers have what was written, at most so long.
  void wait_until_heard(Duration longest) noexcept;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

extern template class Writer<TouchEvent>;
extern template class Writer<Felt>;
extern template class Writer<Heartbeat>;
extern template class Writer<SideStatus>;
extern template class Writer<StopAll>;
extern template class Writer<PairRenewal>;
extern template class Writer<Hug>;

}  // namespace telehug
