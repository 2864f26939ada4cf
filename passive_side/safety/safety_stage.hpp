// SPDX-License-Identifier: Apache-2.0
//
// The last stage before the jacket and the only holder of its link: nothing reaches a motor but through here. Off is
// where everything starts and where everything that goes wrong ends.
#pragma once

#include <array>
#include <boost/container/static_vector.hpp>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/clock.hpp"
#include "common/messages.hpp"
#include "jacket/drive.hpp"
#include "jacket/jacket_profile.hpp"
#include "link/jacket_link.hpp"
#include "link/protocol.hpp"
#include "safety/intensity.hpp"
#include "subscribe/sender_number.hpp"

namespace telehug {

// The microcontroller turns a motor off by itself after at most this long.
inline constexpr Duration longest_command = std::chrono::milliseconds(protocol::drive_max_ms);

struct SafetyLimits {
  double max_strength = 1;             // of full power, 0..1, for all actuators
  Duration longest_drive = 250ms;      // above 0, at most 2 s: a drive's end is at most this far away
  Duration heartbeat_timeout = 250ms;  // above 0, at most 250 ms: how long a sender may be silent
};

// What has been refused, changed or turned off since the start.
struct SafetyCounters {
  std::uint64_t drives_accepted = 0;
  std::uint64_t refused_unknown_actuator = 0;
  std::uint64_t refused_not_finite = 0;
  std::uint64_t refused_by_limit = 0;  // the limits leave nothing that turns the motor
  // apply() as a whole:
  std::uint64_t refused_stopped = 0;
  std::uint64_t refused_no_sender = 0;
  std::uint64_t refused_no_jacket = 0;
  std::uint64_t clamped_strength = 0;
  std::uint64_t clamped_end = 0;
  // Motors turned off, by cause.
  std::uint64_t off_ended = 0;    // the drive said so
  std::uint64_t off_expired = 0;  // the drive's end came
  std::uint64_t off_stop = 0;
  std::uint64_t off_asked = 0;  // all_off()
  std::uint64_t off_heartbeat_lost = 0;
  std::uint64_t off_link_lost = 0;
  std::uint64_t off_clock_jumped = 0;
};

// What became of one apply().
struct SafetyVerdict {
  FeltOutcome outcome = FeltOutcome::driven;  // driven, stopped, stale, jacket_absent or limited
  boost::container::static_vector<std::uint8_t, max_actuators> refused;  // ids of which a limit left nothing

  // For the contact that was to be felt at `actuators`: limited if nothing of it is left.
  [[nodiscard]] FeltOutcome outcome_at(std::span<const std::uint8_t> actuators) const noexcept;
};

// One thread uses it, with times of one clock. Nothing here blocks, and nothing allocates but stop().
//
// Every command lasts no longer than its drive, than 250 ms, and than the last heartbeat of the drive's own sender
// vouches for; so the jacket falls silent in time even if no later byte reaches it. tick() renews commands before they
// run out. Each frame holds the state of all motors that the microcontroller may still be running, so a lost frame is
// mended by the next. Where several senders touch one actuator it runs as strongly as the strongest of them asks, never
// as their sum.
class SafetyStage {
 public:
  // Throws std::invalid_argument for limits out of range, a profile with a channel or strength out of range, no link.
  SafetyStage(std::unique_ptr<JacketLink> link, const JacketProfile& profile, SafetyLimits limits);
  ~SafetyStage();  // everything off
  SafetyStage(const SafetyStage&) = delete;
  SafetyStage& operator=(const SafetyStage&) = delete;

  // Sets what this sender asks of the actuators that `drives` name; all else goes on until its end. Refused as a whole
  // while stopped, while no heartbeat of the sender is fresh (stale), while no jacket answers. A sender beyond
  // max_senders is one that is never heard.
  SafetyVerdict apply(SenderNumber sender, const Drives& drives, Timestamp now);

  // Serves the link; ends what has expired, renews what runs. Call it every 10 to 20 ms.
  void tick(Timestamp now);

  // The sender lives and its pipeline runs. Without one for heartbeat_timeout everything of this sender is off.
  void on_heartbeat(SenderNumber sender, Timestamp now);

  // Off, and stays off until resume(); another stop keeps the first reason.
  void stop(std::string reason, Timestamp now);
  void resume();
  // What this sender drives is off now; its next apply() may drive again.
  void all_off(SenderNumber sender, Timestamp now);
  // Likewise, and it has to be heard anew before that.
  void forget(SenderNumber sender, Timestamp now);

  [[nodiscard]] bool stopped() const noexcept { return stop_reason_.has_value(); }
  [[nodiscard]] std::string stop_reason() const { return stop_reason_.value_or(""); }
  [[nodiscard]] const LinkStatus& link_status() const { return link_->status(); }
  [[nodiscard]] const SafetyCounters& counters() const noexcept { return counters_; }

  // Ids of the actuators that run, in the profile's order.
  [[nodiscard]] boost::container::static_vector<std::uint8_t, max_actuators> running() const;

 private:
  // What one sender asks of one motor.
  struct Share {
    std::uint8_t intensity = 0;  // 0: nothing
    Timestamp end;               // of its drive
  };
  struct Motor {
    std::uint8_t id;
    std::uint8_t channel;
    IntensityScale scale;
    std::array<Share, max_senders> shares{};
    Timestamp silent_from{};  // when the microcontroller has it off even if it hears nothing more

    [[nodiscard]] bool runs() const noexcept;
  };

  Motor* find(std::uint8_t id);
  SafetyVerdict refuse_without_jacket(Timestamp now);
  bool drive(SenderNumber sender, const Drive& drive, Timestamp now);
  [[nodiscard]] Share strongest(const Motor& motor, Timestamp now) const;
  void follow_clock(Timestamp now);
  void follow_link(Timestamp now);
  bool expire(Timestamp now);
  [[nodiscard]] bool armed() const;
  [[nodiscard]] bool lives(SenderNumber sender, Timestamp now) const;
  [[nodiscard]] Timestamp vouched_until(std::size_t sender) const;
  [[nodiscard]] bool renewal_due(Timestamp now) const;
  bool send(Timestamp now);
  std::uint64_t forget_drives();
  bool forget_drives_of(std::size_t sender, std::uint64_t& counter);
  void turn_off(std::uint64_t& counter, Timestamp now);
  void silence(SenderNumber sender, std::uint64_t& counter, Timestamp now);

  std::unique_ptr<JacketLink> link_;
  SafetyLimits limits_;
  std::vector<Motor> motors_;
  std::optional<std::string> stop_reason_;
  std::array<std::optional<Timestamp>, max_senders> heartbeats_;
  Timestamp now_;
  Timestamp sent_;
  bool ready_ = false;  // armed, and given its first all-off
  std::uint64_t reconnects_ = 0;
  SafetyCounters counters_;
};

}  // namespace telehug
