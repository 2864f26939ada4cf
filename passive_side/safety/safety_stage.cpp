// SPDX-License-Identifier: Apache-2.0
#include "safety/safety_stage.hpp"

#include <stdexcept>
#include <utility>

namespace telehug {
namespace {

constexpr Duration most_longest_drive = 2s;

constexpr Timestamp never_heard = Timestamp::min();

SafetyLimits checked(SafetyLimits limits) {
  // Written so that NaN fails.
  if (!(limits.max_strength >= 0 && limits.max_strength <= 1)) {
    throw std::invalid_argument("safety: max_strength must be 0..1");
  }
  if (!(limits.max_celsius >= 0 && limits.max_celsius <= most_celsius)) {
    throw std::invalid_argument("safety: max_celsius must be 0..40");
  }
  if (limits.longest_drive <= 0ms || limits.longest_drive > most_longest_drive) {
    throw std::invalid_argument("safety: longest_drive must be above 0 and at most 2 s");
  }
  if (limits.heartbeat_timeout <= 0ms || limits.heartbeat_timeout > longest_command) {
    throw std::invalid_argument("safety: heartbeat_timeout must be above 0 and at most 250 ms");
  }
  return limits;
}

}  // namespace

SafetyStage::SafetyStage(std::unique_ptr<JacketLink> link, const JacketProfile& profile, SafetyLimits limits)
    : link_(std::move(link)), limits_(checked(limits)), outputs_(profile, limits_, counters_) {
  if (!link_) throw std::invalid_argument("safety: there is no link");
  vouched_.fill(never_heard);
}

SafetyStage::~SafetyStage() {
  link_->stop_all(now_);
  link_->poll(now_);
}

SafetyVerdict SafetyStage::apply(SenderNumber sender, const Drives& drives, Timestamp now) {
  follow_clock(now);
  if (const auto refused = refuse_all(sender, now)) return *refused;
  outputs_.expire(now);
  SafetyVerdict verdict;
  Drives accepted;
  for (const Drive& wanted : drives) {
    const Outputs::Asked asked = outputs_.ask(sender, wanted, permission_, now);
    if (asked == Outputs::Asked::accepted) accepted.push_back(wanted);
    if (asked == Outputs::Asked::muted) verdict.muted.push_back(wanted.actuator);
    if (asked == Outputs::Asked::refused || asked == Outputs::Asked::muted) verdict.refused.push_back(wanted.actuator);
  }
  if (!drives.empty() && !send(now)) return refuse_without_jacket(now);
  // Of what was accepted duty, current or a heater's supervision may have left nothing.
  for (const Drive& wanted : accepted)
    if (!outputs_.runs(wanted.actuator)) verdict.refused.push_back(wanted.actuator);
  if (!drives.empty() && verdict.refused.size() == drives.size()) {
    verdict.outcome = verdict.muted.size() == drives.size() ? FeltOutcome::muted : FeltOutcome::limited;
  }
  return verdict;
}

// The wearer's will first, then whoever asks, then the jacket.
std::optional<SafetyVerdict> SafetyStage::refuse_all(SenderNumber sender, Timestamp now) {
  if (stopped()) {
    ++counters_.refused_stopped;
    return SafetyVerdict{FeltOutcome::stopped, {}, {}};
  }
  if (permission_.refusal) {
    ++(permission_.refusal == FeltOutcome::paused ? counters_.refused_paused : counters_.refused_quiet_hours);
    return SafetyVerdict{*permission_.refusal, {}, {}};
  }
  if (!lives(sender, now)) {
    ++counters_.refused_no_sender;
    silence(sender, counters_.off_heartbeat_lost, now);
    return SafetyVerdict{FeltOutcome::stale, {}, {}};
  }
  if (!ready_ || !armed()) return refuse_without_jacket(now);
  return std::nullopt;
}

SafetyVerdict SafetyStage::refuse_without_jacket(Timestamp now) {
  ++counters_.refused_no_jacket;
  turn_off(counters_.off_link_lost, now);
  return {FeltOutcome::jacket_absent, {}, {}};
}

void SafetyStage::tick(Timestamp now) {
  follow_clock(now);
  link_->poll(now);
  follow_link(now);
  if (!armed()) return;
  for (SenderNumber sender = 0; sender < max_senders; ++sender) {
    if (!lives(sender, now)) silence(sender, counters_.off_heartbeat_lost, now);
  }
  const bool ended = outputs_.expire(now);
  const bool due = ended || outputs_.renewal_due(vouched_, link_->status().telemetry, sent_, now);
  if (due && !send(now)) turn_off(counters_.off_link_lost, now);
}

void SafetyStage::on_heartbeat(SenderNumber sender, Timestamp now) {
  follow_clock(now);
  if (sender >= max_senders) return;
  // What ran until now was vouched for by the last heartbeat only.
  if (!lives(sender, now)) silence(sender, counters_.off_heartbeat_lost, now);
  vouched_[sender] = now + limits_.heartbeat_timeout;
}

void SafetyStage::permit(const Permission& permission, Timestamp now) {
  follow_clock(now);
  if (permission == permission_) return;
  permission_ = permission;
  turn_off(counters_.off_consent, now);
}

void SafetyStage::stop(std::string reason, Timestamp now) {
  follow_clock(now);
  if (!stopped()) stop_reason_ = std::move(reason);
  counters_.off_stop += outputs_.forget();
  link_->stop_all(now);
}

void SafetyStage::resume() {
  stop_reason_.reset();
}

void SafetyStage::all_off(SenderNumber sender, Timestamp now) {
  follow_clock(now);
  silence(sender, counters_.off_asked, now);
}

void SafetyStage::forget(SenderNumber sender, Timestamp now) {
  all_off(sender, now);
  if (sender < max_senders) vouched_[sender] = never_heard;
}

// A clock that goes backwards would lengthen every drive by the jump: everything ends, and every sender has to be heard
// anew.
void SafetyStage::follow_clock(Timestamp now) {
  if (now < now_) {
    turn_off(counters_.off_clock_jumped, now);
    vouched_.fill(never_heard);
    outputs_.forget_time(now);
    sent_ = now;
  }
  now_ = now;
  outputs_.pass(now);
}

// A jacket that has just answered gets an all-off before anything else; what ran before the break is forgotten.
void SafetyStage::follow_link(Timestamp now) {
  const bool same = armed() == ready_ && link_->status().reconnects == reconnects_;
  if (same) return;
  reconnects_ = link_->status().reconnects;
  ready_ = armed();
  counters_.off_link_lost += outputs_.forget();
  outputs_.silent(now);
  link_->stop_all(now);
}

bool SafetyStage::armed() const {
  return link_->status().state == LinkState::armed;
}

bool SafetyStage::lives(SenderNumber sender, Timestamp now) const {
  return sender < max_senders && now < vouched_[sender];
}

bool SafetyStage::send(Timestamp now) {
  sent_ = now;
  const MotorCommands motors = outputs_.motor_commands(vouched_, now);
  if (!motors.empty() && !link_->send(motors, now)) return false;
  const HeaterCommands heaters = outputs_.heater_commands(vouched_, link_->status().telemetry, now);
  if (!heaters.empty() && !link_->heat(heaters, now)) outputs_.forget_heaters();
  return true;
}

// Everything of one sender off; says so to the jacket if it asked for anything. What others ask for goes on.
void SafetyStage::silence(SenderNumber sender, std::uint64_t& counter, Timestamp now) {
  if (sender >= max_senders || !outputs_.forget(sender, counter)) return;
  if (!outputs_.asked()) {
    outputs_.forget();
    link_->stop_all(now);
  } else if (!send(now)) {
    turn_off(counters_.off_link_lost, now);
  }
}

// Everything off because of a fault or the wearer's will; says so to the jacket if anything was on.
void SafetyStage::turn_off(std::uint64_t& counter, Timestamp now) {
  const std::uint64_t ran = outputs_.forget();
  counter += ran;
  if (ran > 0) link_->stop_all(now);
}

}  // namespace telehug
