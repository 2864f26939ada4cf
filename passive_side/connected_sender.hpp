// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <utility>

#include "common/latest_slot.hpp"
#include "daemon/connection.hpp"
#include "daemon/renewal_link.hpp"
#include "passive_pipeline.hpp"
#include "peer_link/one_way.hpp"

namespace telehug {

// What goes between the two beside touches and answers.
class BesideAnswers {
 public:
  BesideAnswers(const std::optional<Pair>& pair, const SessionId& session, const Clock&) : renewal_(pair, session) {}
  void connect(DdsParticipant& participant) {
    renewal_.connect(participant);
    hugs_.connect(participant);
  }
  void disconnect() {
    hugs_.disconnect();
    renewal_.disconnect();
  }
  void serve(WallTime now) { renewal_.serve(now); }
  [[nodiscard]] static std::uint64_t dropped() { return 0; }
  [[nodiscard]] Outgoing<Hug>& hugs() noexcept { return hugs_; }

 private:
  RenewalSender renewal_;
  Outgoing<Hug> hugs_;
};

// One of those who may touch this jacket: the connection to them, and what their touches become.
class ConnectedSender {
 public:
  struct Arrival {
    TouchEvent event;
    Timestamp time;
  };

  // `arrived`: called on a thread of DDS after each event; true: it replaced one that nobody has read.
  ConnectedSender(SenderNumber its_number, Membership membership, const SessionId& session, Duration heartbeat_timeout,
                  PassivePipeline its_pipeline, const Clock& clock, std::function<void(bool replaced)> arrived)
      : number(its_number),
        pipeline(std::move(its_pipeline)),
        connection(std::move(membership), session, heartbeat_timeout, clock,
                   [this, &clock, arrived = std::move(arrived)](const TouchEvent& event) {
                     arrived(newest_event.put({event, clock.now()}));
                   }) {}

  [[nodiscard]] const Membership& membership() const noexcept { return connection.membership(); }
  [[nodiscard]] std::string name() const { return connection.name(); }

  const SenderNumber number;
  PassivePipeline pipeline;  // the drive thread's
  LatestSlot<Arrival> newest_event;
  Connection<Felt, TouchEvent, BesideAnswers> connection;  // last: it calls back as soon as it is there
};

}  // namespace telehug
