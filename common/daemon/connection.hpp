// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>

#include "common/version.hpp"
#include "daemon/link_keeper.hpp"
#include "daemon/membership.hpp"
#include "daemon/peer_absence.hpp"
#include "daemon/status_parts.hpp"
#include "daemon/stop_switch.hpp"
#include "peer_link/peer_link.hpp"
#include "peer_link/traffic.hpp"
#include "service/log.hpp"

namespace telehug {

// A daemon's way to one other PC (or, without a pair, to a daemon on this one): a participant of its own, what goes
// over it, and what is known of the other side. Out and In: what a pipeline sends and hears (Traffic). Beside: what
// else this side has in the participant; it has connect(), disconnect(), serve(WallTime) for housekeeping and, for any
// thread, dropped(), as Traffic's.
template <typename Out, typename In, typename Beside>
class Connection {
 public:
  // Connects; throws as LinkKeeper, PeerLink and Traffic do. `hear` is called on a thread of DDS until this is gone.
  // `clock` outlives it.
  Connection(Membership membership, const SessionId& session, Duration heartbeat_timeout, const Clock& clock,
             typename Reader<In>::Callback hear)
      : membership_(std::move(membership)),
        keeper_(membership_.dds, clock),
        peer_(keeper_.participant(), membership_.dds.side, session, heartbeat_timeout, clock),
        traffic_(std::move(hear)),
        beside_(membership_.pair, session, clock) {
    traffic_.connect(keeper_.participant());
    beside_.connect(keeper_.participant());
  }
  ~Connection() {
    beside_.disconnect();
    traffic_.disconnect();
    peer_.disconnect();
  }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  // --- pipeline's thread ---

  std::optional<HeardHeartbeat> serve(Timestamp now) { return peer_.serve(now); }
  [[nodiscard]] bool alive(Timestamp now) noexcept { return peer_.alive(now); }
  [[nodiscard]] const SessionId& peer_session() const noexcept { return peer_.peer_session(); }
  bool write(const Out& message) noexcept { return traffic_.write(message); }
  // Tells the other threads how the peer is; leaves it for the next time while one of them looks.
  void tell_state(Timestamp now) {
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (lock.owns_lock()) state_ = peer_.state(now);
  }

  // --- housekeeping thread ---

  // Tells the peer of this side, hears what it tells of itself, replaces the participant when that is due.
  void keep(const SideStatus& own, const StopSwitch& stop, WallTime wall_now) {
    stop.tell(peer_);
    if (auto told = peer_.take_peer_status()) {
      const std::lock_guard lock(mutex_);
      told_ = *std::move(told);
    }
    peer_.tell(own);
    beside_.serve(wall_now);
    const PeerState peer = state();
    keeper_.serve(peer, LinkKeeper::endpoints(peer_, traffic_, beside_));
    const auto absence = [&] {
      return peer_absence(membership_.dds.side, membership_.pair.has_value(), told(), keeper_.strangers().stranger());
    };
    const std::string peer_name = name();
    say_peer_.say(spdlog::level::info, peer.alive ? peer_name + " is connected" : peer_name + ": " + absence().what,
                  {.stage = "link",
                   .peer = peer_name,
                   .message_id = peer.alive ? message_id::peer_connected : message_id::peer_absent});
  }

  // The last word, when the pair is over; waits a moment for the peer to have it.
  void tell_pair_over() { peer_.tell_pair_over(version); }

  // --- any thread ---

  [[nodiscard]] const Membership& membership() const noexcept { return membership_; }
  // For sentences: the pair's name, or that it is the other side.
  [[nodiscard]] std::string name() const { return name_of(membership_.pair); }
  [[nodiscard]] bool stopped_by_peer() const noexcept { return peer_.stopped_by_peer(); }
  // Messages that were malformed or out of range.
  [[nodiscard]] std::uint64_t dropped() const { return peer_.dropped() + traffic_.dropped() + beside_.dropped(); }
  [[nodiscard]] Beside& beside() noexcept { return beside_; }
  [[nodiscard]] PeerState state() const {
    const std::lock_guard lock(mutex_);
    return state_;
  }
  // What the peer last told of itself, if it has.
  [[nodiscard]] std::optional<SideStatus> told() const {
    const std::lock_guard lock(mutex_);
    return told_;
  }
  [[nodiscard]] ConnectionStatus status() const {
    return {membership_.pair,
            state(),
            told(),
            keeper_.status(),
            peer_.stopped_by_peer(),
            dropped(),
            keeper_.strangers().stranger(),
            keeper_.strangers().refusals()};
  }

 private:
  const Membership membership_;
  LinkKeeper keeper_;
  PeerLink peer_;
  Traffic<Out, In> traffic_;
  Beside beside_;
  SayOnChange say_peer_;
  mutable std::mutex mutex_;  // guards what follows
  PeerState state_;
  std::optional<SideStatus> told_;
};

}  // namespace telehug
