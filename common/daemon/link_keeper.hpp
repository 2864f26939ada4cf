// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>

#include "daemon/stranger_note.hpp"
#include "dds/participant.hpp"
#include "network/address_watcher.hpp"
#include "network/suspend_detector.hpp"
#include "peer/link_supervisor.hpp"
#include "peer_link/peer_link.hpp"

namespace telehug {

// Holds a daemon's participant, and replaces it when LinkSupervisor says so. Where only loopback is used neither the
// PC's addresses nor its sleep matter.
class LinkKeeper {
 public:
  // Makes the first participant; throws as DdsParticipant does, or std::system_error.
  LinkKeeper(DdsSettings settings, const Clock& clock);

  // The first one: only until serve() is called.
  [[nodiscard]] DdsParticipant& participant() noexcept { return *participant_; }

  // What a daemon has in the participant is taken out of it, and put into the next one (which may throw).
  struct Endpoints {
    std::function<void()> disconnect;
    std::function<void(DdsParticipant&)> connect;
  };

  // Of a PeerLink, a Traffic and what else is in the participant.
  template <typename... Others>
  [[nodiscard]] static Endpoints endpoints(PeerLink& peer, Others&... others) {
    return {.disconnect =
                [&] {
                  (others.disconnect(), ...);
                  peer.disconnect();
                },
            .connect =
                [&](DdsParticipant& participant) {
                  peer.connect(participant);
                  (others.connect(participant), ...);
                }};
  }

  // Housekeeping thread, every round.
  void serve(const PeerState& peer, const Endpoints& endpoints);

  // Any thread.
  [[nodiscard]] nlohmann::json status() const;
  [[nodiscard]] const StrangerNote& strangers() const noexcept { return strangers_; }

 private:
  void look_at_network(Timestamp now);
  void look_at_peer(const PeerState& peer, Timestamp now);
  void look_at_strangers(Timestamp now);
  void look_at_memory(Timestamp now);
  void replace(LinkCause cause, const Endpoints& endpoints);

  DdsSettings settings_;
  const Clock& clock_;
  std::optional<AddressWatcher> addresses_;  // unless only loopback is used
  SuspendDetector sleep_;
  LinkSupervisor supervisor_;
  std::optional<DdsParticipant> participant_;
  SessionId peer_session_{};
  StrangerNote strangers_;
  std::uint64_t signs_ = 0;  // of peers, seen by the present participant
  Timestamp memory_looked_at_;
  std::optional<Timestamp> served_at_;
  mutable std::mutex told_mutex_;
  nlohmann::json told_;  // guarded by told_mutex_
};

}  // namespace telehug
