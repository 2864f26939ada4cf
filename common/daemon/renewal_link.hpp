// SPDX-License-Identifier: Apache-2.0
//
// How a pair renews itself while both PCs are connected: the wearer's side offers, the parent's takes. Fast DDS looks
// at certificates only when two sides meet, so the participant that runs may stay; the next one reads the new files.
#pragma once

#include <cstdint>
#include <mutex>
#include <optional>
#include <string>

#include "common/latest_slot.hpp"
#include "common/messages.hpp"
#include "dds/participant.hpp"
#include "dds/reader.hpp"
#include "dds/writer.hpp"
#include "pairing/renewal_offer.hpp"

namespace telehug {

// Wearer's side. Housekeeping thread.
class RenewalSender {
 public:
  // Without a pair it does nothing.
  RenewalSender(const std::optional<Pair>& pair, SessionId session);

  // Renews the pair when it is time, and tells what is new.
  void serve(WallTime now);

  // As PeerLink's; what was told is told again.
  void disconnect() { writer_.reset(); }
  void connect(DdsParticipant& participant);  // throws as Writer does, and is disconnected then

 private:
  std::optional<Pair> pair_;
  std::optional<RenewalOffer> offer_;
  SessionId session_;
  std::string offered_;  // certificate
  bool told_ = false;    // by the present writer
  std::optional<Writer<PairRenewal>> writer_;
};

// Parent's side.
class RenewalReceiver {
 public:
  // Without a pair it does nothing.
  explicit RenewalReceiver(const std::optional<Pair>& pair);

  // --- housekeeping thread ---

  // Installs what came.
  void serve(WallTime now);

  // As PeerLink's.
  void disconnect();
  void connect(DdsParticipant& participant);  // throws as Reader does, and is disconnected then

  // --- any thread ---

  [[nodiscard]] std::uint64_t dropped() const;  // messages that were malformed or out of range

 private:
  std::optional<Pair> pair_;
  LatestSlot<PairRenewal> slot_;
  std::string told_problem_;
  mutable std::mutex counting_;
  std::uint64_t dropped_before_ = 0;
  std::optional<Reader<PairRenewal>> reader_;
};

}  // namespace telehug
