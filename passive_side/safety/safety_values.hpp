// SPDX-License-Identifier: Apache-2.0
//
// What the safety stage is told, what it answers, and what it counts.
#pragma once

#include <algorithm>
#include <boost/container/static_vector.hpp>
#include <cstdint>
#include <optional>
#include <span>

#include "common/clock.hpp"
#include "common/messages.hpp"
#include "jacket/drive.hpp"
#include "jacket/jacket_profile.hpp"
#include "link/protocol.hpp"
#include "safety/heater_supervision.hpp"

namespace telehug {

using Refused = boost::container::static_vector<std::uint8_t, max_actuators>;  // ids of actuators

struct SafetyLimits {
  double max_strength = 1;             // 0..1 of full power, for all actuators
  Duration longest_drive = 250ms;      // above 0, at most 2 s: a drive's end is at most this far away
  Duration heartbeat_timeout = 250ms;  // above 0, at most 250 ms: how long a sender may be silent
  double max_celsius = most_celsius;   // of all heaters, 0..40; below least_celsius: none heats
};

// What has been refused, changed or turned off since the start.
struct SafetyCounters {
  std::uint64_t drives_accepted = 0;
  std::uint64_t refused_unknown_actuator = 0;
  std::uint64_t refused_not_finite = 0;
  std::uint64_t refused_by_limit = 0;  // the limits leave nothing that turns the motor, or no set-point
  std::uint64_t refused_muted = 0;     // by the wearer, or not enabled in the profile
  // apply() as a whole:
  std::uint64_t refused_stopped = 0;
  std::uint64_t refused_paused = 0;
  std::uint64_t refused_quiet_hours = 0;
  std::uint64_t refused_no_sender = 0;
  std::uint64_t refused_no_jacket = 0;
  std::uint64_t clamped_strength = 0;
  std::uint64_t clamped_end = 0;
  // Commands to a motor, renewals included, that were weakened or left out:
  std::uint64_t limited_by_duty = 0;
  std::uint64_t limited_by_current = 0;
  // Commands to a heater that were left out: its supervision forbids it, or the jacket takes none.
  std::uint64_t limited_by_heater = 0;
  // Actuators turned off, by cause.
  std::uint64_t off_ended = 0;    // the drive said so
  std::uint64_t off_expired = 0;  // the drive's end came
  std::uint64_t off_stop = 0;
  std::uint64_t off_consent = 0;  // the wearer wants something else now
  std::uint64_t off_asked = 0;    // all_off()
  std::uint64_t off_heartbeat_lost = 0;
  std::uint64_t off_link_lost = 0;
  std::uint64_t off_clock_jumped = 0;
};

// Of one motor: the share of its duty's budget that is used up.
struct DutyReport {
  std::uint8_t id = 0;
  double used = 0;  // 0..1
};
using DutyReports = boost::container::static_vector<DutyReport, max_actuators>;

// What became of one apply().
struct SafetyVerdict {
  FeltOutcome outcome =
      FeltOutcome::driven;  // driven, stopped, paused, quiet_hours, stale, jacket_absent, limited, muted
  Refused refused;          // of which a limit or the wearer left nothing
  Refused muted;            // those of them of which it was the wearer

  [[nodiscard]] bool refuses(std::uint8_t actuator) const noexcept {
    return std::ranges::find(refused, actuator) != refused.end();
  }
  // For the contact that was to be felt at `actuators`: limited if nothing of it is left, muted if that is the wearer's
  // doing alone.
  [[nodiscard]] FeltOutcome outcome_at(std::span<const std::uint8_t> actuators) const noexcept {
    if (outcome != FeltOutcome::driven && outcome != FeltOutcome::limited && outcome != FeltOutcome::muted) {
      return outcome;
    }
    const auto all_in = [actuators](const Refused& ids) {
      return std::ranges::all_of(actuators,
                                 [&ids](std::uint8_t id) { return std::ranges::find(ids, id) != ids.end(); });
    };
    if (!all_in(refused)) return FeltOutcome::driven;
    return !actuators.empty() && all_in(muted) ? FeltOutcome::muted : FeltOutcome::limited;
  }
};

// How a heater is, for status.
struct HeaterReport {
  std::uint8_t id = 0;  // of its actuator
  HeaterState state = HeaterState::no_telemetry;
  protocol::HeaterFault fault = protocol::HeaterFault::none;
  double set_point_celsius = 0;   // 0: off
  std::optional<double> celsius;  // what its sensor says
};
using HeaterReports = boost::container::static_vector<HeaterReport, protocol::heater_count>;

}  // namespace telehug
