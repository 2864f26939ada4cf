// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <mutex>
#include <optional>
#include <string>

#include "common/clock.hpp"
#include "common/latest_slot.hpp"
#include "common/messages.hpp"
#include "dds/participant.hpp"
#include "dds/reader.hpp"
#include "dds/writer.hpp"
#include "peer/heartbeat_exchange.hpp"
#include "peer/peer_monitor.hpp"
#include "peer_link/stop_latch.hpp"

namespace telehug {

// What one side knows of the other, for its status.
struct PeerState {
  bool alive = false;
  SessionId session;
  std::optional<Duration> round_trip;
  std::optional<Duration> one_way;  // from the peer to here (HeartbeatExchange)
  std::uint64_t losses = 0;
};

// A heartbeat and when it came.
struct HeardHeartbeat {
  Heartbeat heartbeat;
  Timestamp time;
};

// Heartbeats, status and stop between this side and the other. Serve it from the pipeline's own thread: a heartbeat
// says that the pipeline runs.
class PeerLink {
 public:
  // Connects. Throws as Reader and Writer do. `clock` outlives it; `participant` until disconnect().
  PeerLink(DdsParticipant& participant, Side side, const SessionId& session, Duration heartbeat_timeout,
           const Clock& clock);

  // --- pipeline's thread ---

  // Takes in what came and sends what is due; while the participant is being replaced nothing goes out, and nobody
  // waits for it. The peer's newest heartbeat, if a fresh one was among it.
  std::optional<HeardHeartbeat> serve(Timestamp now);

  [[nodiscard]] bool alive(Timestamp now) noexcept { return monitor_.alive(now); }
  [[nodiscard]] const SessionId& peer_session() const noexcept { return monitor_.session(); }
  [[nodiscard]] PeerState state(Timestamp now);

  // --- housekeeping thread ---

  // The participant can be replaced while all else goes on: disconnect, delete the old one, make another, connect. What
  // is known of the peer, its stop, and the counting of heartbeats survive; status and stop are told again.
  void disconnect();
  void connect(DdsParticipant& participant);  // throws as Reader and Writer do, and is disconnected then

  // Tells the peer if it differs from what was told last. What the wire refuses of a reason (line breaks, bytes that
  // are no UTF-8) is replaced.
  void tell(const SideStatus& status);
  // The last word of a side whose pair is over; waits a moment for the peer to have it.
  void tell_pair_over(const std::string& version);
  // False if DDS refused it: tell it again.
  [[nodiscard]] bool tell_stop(bool stop, const std::string& reason);
  // The last word that DDS took, if any.
  [[nodiscard]] const std::optional<StopAll>& stop_told() const noexcept { return stop_told_; }
  [[nodiscard]] std::optional<SideStatus> take_peer_status() { return status_slot_.take(); }

  // --- any thread ---

  // Has the peer turned everything off, and not on again (StopLatch)?
  [[nodiscard]] bool stopped_by_peer() const noexcept { return stop_latch_.stopped(); }
  [[nodiscard]] std::uint64_t dropped() const;  // messages that were malformed or out of range

 private:
  struct Endpoints {
    Endpoints(DdsParticipant& participant, PeerLink& owner);

    Writer<Heartbeat> heartbeat_writer;
    Writer<SideStatus> status_writer;
    Writer<StopAll> stop_writer;
    Reader<Heartbeat> heartbeat_reader;  // last: they call back as soon as they are there
    Reader<SideStatus> status_reader;
    Reader<StopAll> stop_reader;

    [[nodiscard]] std::uint64_t dropped() const noexcept;
  };

  void tell_stop_again();

  Side side_;
  SessionId session_;
  const Clock& clock_;
  HeartbeatExchange exchange_;
  PeerMonitor monitor_;
  LatestSlot<HeardHeartbeat> heartbeat_slot_;
  LatestSlot<SideStatus> status_slot_;
  StopLatch stop_latch_;
  std::optional<SideStatus> told_;
  std::optional<StopAll> stop_told_;
  bool stop_to_tell_again_ = false;

  // Only housekeeping changes the endpoints, and holds both meanwhile. The pipeline only tries the first, which nobody
  // else takes: a look at the counters must not cost a heartbeat.
  std::mutex sending_;
  mutable std::mutex counting_;
  std::uint64_t dropped_before_ = 0;  // by endpoints that are gone
  std::optional<Endpoints> endpoints_;
};

}  // namespace telehug
