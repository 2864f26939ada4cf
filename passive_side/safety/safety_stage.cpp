// SPDX-License-Identifier: Apache-2.0
#include "safety/safety_stage.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace telehug {
namespace {

constexpr Duration most_longest_drive = 2s;
// Commands are renewed this often: a frame lost on the wire is mended soon, and 20 frames/s leave room on any wire.
constexpr Duration renewal_interval = 50ms;
// ... and at the latest this long before one runs out: more than two ticks.
constexpr Duration renewal_margin = 45ms;

constexpr std::uint64_t one_if(bool condition) {
  return condition ? 1 : 0;
}

bool unit_interval(double value) {
  return value >= 0 && value <= 1;
}  // false for NaN

void check(const SafetyLimits& limits) {
  if (!unit_interval(limits.max_strength)) throw std::invalid_argument("safety: max_strength must be 0..1");
  if (limits.longest_drive <= 0ms || limits.longest_drive > most_longest_drive) {
    throw std::invalid_argument("safety: longest_drive must be above 0 and at most 2 s");
  }
  if (limits.heartbeat_timeout <= 0ms || limits.heartbeat_timeout > longest_command) {
    throw std::invalid_argument("safety: heartbeat_timeout must be above 0 and at most 250 ms");
  }
}

void check(const JacketProfile& profile) {
  if (profile.actuators.empty() || profile.actuators.size() > motor_channels) {
    throw std::invalid_argument("safety: a jacket has 1..16 motors");
  }
  for (const Actuator& actuator : profile.actuators) {
    if (actuator.channel >= motor_channels) throw std::invalid_argument("safety: a channel must be 0..15");
    if (!unit_interval(actuator.max_strength) || !unit_interval(actuator.min_strength)) {
      throw std::invalid_argument("safety: strengths of an actuator must be 0..1");
    }
  }
}

}  // namespace

FeltOutcome SafetyVerdict::outcome_at(std::span<const std::uint8_t> actuators) const noexcept {
  if (outcome != FeltOutcome::driven && outcome != FeltOutcome::limited) return outcome;
  const bool something_left = std::ranges::any_of(
      actuators, [this](std::uint8_t id) { return std::ranges::find(refused, id) == refused.end(); });
  return something_left ? FeltOutcome::driven : FeltOutcome::limited;
}

SafetyStage::SafetyStage(std::unique_ptr<JacketLink> link, const JacketProfile& profile, SafetyLimits limits)
    : link_(std::move(link)), limits_(limits) {
  if (!link_) throw std::invalid_argument("safety: there is no link");
  check(limits_);
  check(profile);
  for (const Actuator& actuator : profile.actuators) {
    if (!actuator.enabled || actuator.kind != ActuatorKind::motor) continue;
    const double most = std::min(actuator.max_strength, limits_.max_strength);
    motors_.push_back({actuator.id, actuator.channel, {actuator.min_strength, most}});
  }
}

SafetyStage::~SafetyStage() {
  link_->stop_all(now_);
  link_->poll(now_);
}

SafetyVerdict SafetyStage::apply(SenderNumber sender, const Drives& drives, Timestamp now) {
  follow_clock(now);
  if (stopped()) {
    ++counters_.refused_stopped;
    return {FeltOutcome::stopped, {}};
  }
  if (!lives(sender, now)) {
    ++counters_.refused_no_sender;
    silence(sender, counters_.off_heartbeat_lost, now);
    return {FeltOutcome::stale, {}};
  }
  if (!ready_ || !armed()) return refuse_without_jacket(now);
  expire(now);
  SafetyVerdict verdict;
  for (const Drive& wanted : drives) {
    if (!drive(sender, wanted, now)) verdict.refused.push_back(wanted.actuator);
  }
  if (!drives.empty() && !send(now)) return refuse_without_jacket(now);
  if (!drives.empty() && verdict.refused.size() == drives.size()) verdict.outcome = FeltOutcome::limited;
  return verdict;
}

SafetyVerdict SafetyStage::refuse_without_jacket(Timestamp now) {
  ++counters_.refused_no_jacket;
  turn_off(counters_.off_link_lost, now);
  return {FeltOutcome::jacket_absent, {}};
}

// False if nothing may come of a drive that asks for something. Whatever is wrong with it, its sender asks nothing of
// the motor then.
bool SafetyStage::drive(SenderNumber sender, const Drive& wanted, Timestamp now) {
  Motor* motor = find(wanted.actuator);
  if (motor == nullptr) {
    ++counters_.refused_unknown_actuator;
    return false;
  }
  const bool was_on = motor->runs();
  Share& share = motor->shares[sender];
  share.intensity = 0;
  if (!std::isfinite(wanted.strength)) {
    ++counters_.refused_not_finite;
    return false;
  }
  if (wanted.strength <= 0 || wanted.end <= now) {
    counters_.off_ended += one_if(was_on && !motor->runs());
    return true;
  }
  share.intensity = motor->scale.intensity(wanted.strength);
  if (share.intensity == 0) {
    ++counters_.refused_by_limit;
    return false;
  }
  share.end = std::min(wanted.end, now + limits_.longest_drive);
  ++counters_.drives_accepted;
  counters_.clamped_strength += one_if(wanted.strength > 1);
  counters_.clamped_end += one_if(share.end < wanted.end);
  return true;
}

void SafetyStage::tick(Timestamp now) {
  follow_clock(now);
  link_->poll(now);
  follow_link(now);
  if (!armed()) return;
  for (SenderNumber sender = 0; sender < max_senders; ++sender) {
    if (!lives(sender, now)) silence(sender, counters_.off_heartbeat_lost, now);
  }
  if ((expire(now) || renewal_due(now)) && !send(now)) turn_off(counters_.off_link_lost, now);
}

void SafetyStage::on_heartbeat(SenderNumber sender, Timestamp now) {
  follow_clock(now);
  if (sender >= max_senders) return;
  // What ran until now was vouched for by the last heartbeat only.
  if (!lives(sender, now)) silence(sender, counters_.off_heartbeat_lost, now);
  heartbeats_[sender] = now;
}

void SafetyStage::stop(std::string reason, Timestamp now) {
  follow_clock(now);
  if (!stopped()) stop_reason_ = std::move(reason);
  counters_.off_stop += forget_drives();
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
  if (sender < max_senders) heartbeats_[sender].reset();
}

boost::container::static_vector<std::uint8_t, max_actuators> SafetyStage::running() const {
  boost::container::static_vector<std::uint8_t, max_actuators> ids;
  for (const Motor& motor : motors_) {
    if (motor.runs()) ids.push_back(motor.id);
  }
  return ids;
}

bool SafetyStage::Motor::runs() const noexcept {
  return std::ranges::any_of(shares, [](const Share& share) { return share.intensity > 0; });
}

// What the motor is to do now: the strongest wish, until its end or as long as its own sender's heartbeat vouches for.
SafetyStage::Share SafetyStage::strongest(const Motor& motor, Timestamp now) const {
  Share strongest;
  for (std::size_t sender = 0; sender < max_senders; ++sender) {
    const Share& share = motor.shares[sender];
    const Timestamp end = std::min({share.end, vouched_until(sender), now + longest_command});
    if (share.intensity == 0 || end <= now) continue;
    const bool stronger = share.intensity > strongest.intensity;
    const bool longer = share.intensity == strongest.intensity && end > strongest.end;
    if (stronger || longer) strongest = {share.intensity, end};
  }
  return strongest;
}

SafetyStage::Motor* SafetyStage::find(std::uint8_t id) {
  const auto found = std::ranges::find(motors_, id, &Motor::id);
  return found == motors_.end() ? nullptr : &*found;
}

// A clock that goes backwards would lengthen every drive by the jump: everything ends, and every sender has to be heard
// anew.
void SafetyStage::follow_clock(Timestamp now) {
  if (now < now_) {
    turn_off(counters_.off_clock_jumped, now);
    heartbeats_.fill(std::nullopt);
    for (Motor& motor : motors_)
      motor.silent_from = now;
    sent_ = now;
  }
  now_ = now;
}

// A jacket that has just answered gets an all-off before anything else; what ran before the break is forgotten.
void SafetyStage::follow_link(Timestamp now) {
  const bool same = armed() == ready_ && link_->status().reconnects == reconnects_;
  if (same) return;
  reconnects_ = link_->status().reconnects;
  ready_ = armed();
  counters_.off_link_lost += forget_drives();
  for (Motor& motor : motors_)
    motor.silent_from = now;
  link_->stop_all(now);
}

// Ends what has come to its end; true if something has.
bool SafetyStage::expire(Timestamp now) {
  bool something_ended = false;
  for (Motor& motor : motors_) {
    const bool ran = motor.runs();
    for (Share& share : motor.shares) {
      if (share.intensity == 0 || share.end > now) continue;
      share.intensity = 0;
      something_ended = true;
    }
    counters_.off_expired += one_if(ran && !motor.runs());
  }
  return something_ended;
}

bool SafetyStage::armed() const {
  return link_->status().state == LinkState::armed;
}

bool SafetyStage::lives(SenderNumber sender, Timestamp now) const {
  return sender < max_senders && now < vouched_until(sender);
}

Timestamp SafetyStage::vouched_until(std::size_t sender) const {
  return heartbeats_[sender] ? *heartbeats_[sender] + limits_.heartbeat_timeout : Timestamp::min();
}

bool SafetyStage::renewal_due(Timestamp now) const {
  const bool interval_over = now - sent_ >= renewal_interval;
  return std::ranges::any_of(motors_, [&](const Motor& motor) {
    if (!motor.runs()) return interval_over && motor.silent_from > now;
    const bool runs_out = motor.silent_from - now <= renewal_margin;
    return interval_over || (runs_out && strongest(motor, now).end > motor.silent_from);
  });
}

bool SafetyStage::send(Timestamp now) {
  MotorCommands commands;
  for (Motor& motor : motors_) {
    if (const Share share = strongest(motor, now); share.intensity > 0) {
      commands.push_back({motor.channel, share.intensity, share.end - now});
      motor.silent_from = std::max(motor.silent_from, share.end);
    } else if (motor.silent_from > now) {
      commands.push_back({motor.channel, 0, {}});
    }
  }
  sent_ = now;
  return commands.empty() || link_->send(commands, now);
}

std::uint64_t SafetyStage::forget_drives() {
  std::uint64_t ran = 0;
  for (Motor& motor : motors_) {
    ran += one_if(motor.runs());
    motor.shares.fill({});
  }
  return ran;
}

// True if it had asked for anything. `counter`: of the motors that are off by that.
bool SafetyStage::forget_drives_of(std::size_t sender, std::uint64_t& counter) {
  bool asked = false;
  for (Motor& motor : motors_) {
    if (std::exchange(motor.shares[sender], {}).intensity == 0) continue;
    asked = true;
    counter += one_if(!motor.runs());
  }
  return asked;
}

// Everything of one sender off; says so to the jacket if it asked for anything. What others ask for goes on.
void SafetyStage::silence(SenderNumber sender, std::uint64_t& counter, Timestamp now) {
  if (sender >= max_senders || !forget_drives_of(sender, counter)) return;
  const bool others = std::ranges::any_of(motors_, [](const Motor& motor) { return motor.runs(); });
  if (!others) {
    link_->stop_all(now);
  } else if (!send(now)) {
    turn_off(counters_.off_link_lost, now);
  }
}

// Everything off because of a fault; says so to the jacket if a motor was on.
void SafetyStage::turn_off(std::uint64_t& counter, Timestamp now) {
  const std::uint64_t ran = forget_drives();
  counter += ran;
  if (ran > 0) link_->stop_all(now);
}

}  // namespace telehug
