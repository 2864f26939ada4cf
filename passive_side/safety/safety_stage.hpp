// SPDX-License-Identifier: Apache-2.0
//
// The last stage before the jacket and the only holder of its link: nothing reaches a motor or heater but through here.
// Off is where everything starts and where everything that goes wrong ends.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "common/clock.hpp"
#include "jacket/drive.hpp"
#include "jacket/jacket_profile.hpp"
#include "link/jacket_link.hpp"
#include "safety/consent.hpp"
#include "safety/outputs.hpp"
#include "safety/safety_values.hpp"
#include "safety/shares.hpp"
#include "subscribe/sender_number.hpp"

namespace telehug {

// One thread uses it, with times of one clock. Nothing here blocks, and nothing allocates but stop().
//
// Every command lasts no longer than its drive, than 250 ms, and than the last heartbeat of the drive's own sender
// vouches for; so the jacket falls silent in time even if no later byte reaches it. tick() renews commands before they
// run out. Each frame holds the state of all motors that the microcontroller may still be running, so a lost frame is
// mended by the next. Where several senders touch one actuator it runs as strongly as the strongest of them asks, never
// as their sum. What comes of it then is weakened to each motor's duty (duty_budget.hpp) and to what the supply gives
// (current_budget.hpp); a heater heats only while its supervision lets it (heater_supervision.hpp).
class SafetyStage {
 public:
  // Throws std::invalid_argument for limits or a profile out of range, no link.
  SafetyStage(std::unique_ptr<JacketLink> link, const JacketProfile& profile, SafetyLimits limits);
  ~SafetyStage();  // everything off
  SafetyStage(const SafetyStage&) = delete;
  SafetyStage& operator=(const SafetyStage&) = delete;

  // Sets what this sender asks of the actuators that `drives` name; all else goes on until its end. Refused as a whole
  // while stopped, while the wearer wants nothing (paused, quiet_hours), while no heartbeat of the sender is fresh
  // (stale), while no jacket answers. A sender beyond max_senders is one that is never heard.
  SafetyVerdict apply(SenderNumber sender, const Drives& drives, Timestamp now);

  // Serves the link; ends what has expired, renews what runs. Call it every 10 to 20 ms.
  void tick(Timestamp now);

  // The sender lives and its pipeline runs. Without one for heartbeat_timeout everything of this sender is off.
  void on_heartbeat(SenderNumber sender, Timestamp now);

  // What the wearer wants from now on. Whenever that changes everything that runs ends; the next apply() takes up what
  // still may be. At first everything is permitted.
  void permit(const Permission& permission, Timestamp now);

  // Off, and stays off until resume(); another stop keeps the first reason.
  void stop(std::string reason, Timestamp now);
  void resume();
  // What this sender drives is off now; its next apply() may drive again.
  void all_off(SenderNumber sender, Timestamp now);
  // Likewise, and it has to be heard anew before that.
  void forget(SenderNumber sender, Timestamp now);

  [[nodiscard]] bool stopped() const noexcept { return stop_reason_.has_value(); }
  [[nodiscard]] std::string stop_reason() const { return stop_reason_.value_or(""); }
  [[nodiscard]] const Permission& permission() const noexcept { return permission_; }
  [[nodiscard]] const LinkStatus& link_status() const { return link_->status(); }
  [[nodiscard]] const SafetyCounters& counters() const noexcept { return counters_; }

  // Ids of the actuators that run, in the profile's order.
  [[nodiscard]] Refused running() const { return outputs_.running(); }
  [[nodiscard]] DutyReports duties() { return outputs_.duties(now_); }
  [[nodiscard]] HeaterReports heaters() const { return outputs_.heaters(link_->status().telemetry, now_); }

 private:
  std::optional<SafetyVerdict> refuse_all(SenderNumber sender, Timestamp now);
  SafetyVerdict refuse_without_jacket(Timestamp now);
  void follow_clock(Timestamp now);
  void follow_link(Timestamp now);
  [[nodiscard]] bool armed() const;
  [[nodiscard]] bool lives(SenderNumber sender, Timestamp now) const;
  bool send(Timestamp now);
  void turn_off(std::uint64_t& counter, Timestamp now);
  void silence(SenderNumber sender, std::uint64_t& counter, Timestamp now);

  std::unique_ptr<JacketLink> link_;
  SafetyLimits limits_;
  SafetyCounters counters_;
  Outputs outputs_;
  Permission permission_;
  std::optional<std::string> stop_reason_;
  Vouched vouched_;
  Timestamp now_;
  Timestamp sent_;
  bool ready_ = false;  // armed, and given its first all-off
  std::uint64_t reconnects_ = 0;
};

}  // namespace telehug
