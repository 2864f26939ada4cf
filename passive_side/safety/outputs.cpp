// SPDX-License-Identifier: Apache-2.0
#include "safety/outputs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "safety/current_budget.hpp"
#include "safety/muted_place.hpp"

namespace telehug {
namespace {

// Commands are renewed this often: a frame lost on the wire is mended soon, and 20 frames/s leave room on any wire.
constexpr Duration renewal_interval = 50ms;
// ... and at the latest this long before one runs out: more than two ticks.
constexpr Duration renewal_margin = 45ms;

constexpr Duration most_duty_window = 10min;
constexpr double rounding = 1e-6;

constexpr std::uint64_t one_if(bool condition) {
  return condition ? 1 : 0;
}

// All of them are false for NaN.
bool unit_interval(double value) {
  return value >= 0 && value <= 1;
}
bool current(double ma) {
  return ma >= 0 && std::isfinite(ma);
}

void check(const JacketProfile& profile, ActuatorKind kind, std::size_t channels) {
  std::array<bool, motor_channels> taken{};
  for (const Actuator& actuator : profile.actuators) {
    if (actuator.kind != kind) continue;
    if (actuator.channel >= channels) {
      throw std::invalid_argument("safety: a channel must be 0..15 of motors, 0..1 of heaters");
    }
    if (taken.at(actuator.channel)) throw std::invalid_argument("safety: a channel must have one actuator");
    taken.at(actuator.channel) = true;
  }
}

void check(const JacketProfile& profile) {
  if (profile.actuators.empty()) throw std::invalid_argument("safety: a jacket has at least one actuator");
  check(profile, ActuatorKind::motor, motor_channels);
  check(profile, ActuatorKind::heater, heater_channels);
  if (!current(profile.supply_ma)) throw std::invalid_argument("safety: the supply's current must be 0 or more");
  if (profile.duty_window <= 0ms || profile.duty_window > most_duty_window) {
    throw std::invalid_argument("safety: duty_window must be above 0 and at most 10 minutes");
  }
  for (const Actuator& actuator : profile.actuators) {
    if (!unit_interval(actuator.max_strength) || !unit_interval(actuator.min_strength)) {
      throw std::invalid_argument("safety: strengths of an actuator must be 0..1");
    }
    if (!unit_interval(actuator.max_duty) || actuator.max_duty <= 0) {
      throw std::invalid_argument("safety: max_duty of an actuator must be above 0 and at most 1");
    }
    if (!current(actuator.current_ma)) throw std::invalid_argument("safety: an actuator's current must be 0 or more");
  }
}

}  // namespace

void Outputs::Output::give(double level, Timestamp until) {
  given = level;
  given_until = until;
  if (level > 0) silent_from = std::max(silent_from, until);
}

Outputs::Motor::Motor(const Actuator& actuator, const JacketProfile& profile, double most)
    : Output(actuator),
      scale(actuator.min_strength, std::min(actuator.max_strength, most)),
      duty(actuator.max_duty, profile.duty_window),
      max_power(actuator.max_strength),
      full_ma(actuator.current_ma) {}

// A limit of strength shrinks the range above least_celsius; what allows no strength allows no warmth.
Outputs::Heater::Heater(const Actuator& actuator, const SafetyLimits& limits)
    : Output(actuator), most_celsius(0), supervision(actuator.channel) {
  const double strength = std::min(actuator.max_strength, limits.max_strength);
  const double celsius = std::min(actuator.max_celsius, limits.max_celsius);
  if (strength > 0) most_celsius = least_celsius + strength * (celsius - least_celsius);
}

Outputs::Outputs(const JacketProfile& profile, const SafetyLimits& limits, SafetyCounters& counters)
    : counters_(counters), supply_ma_(profile.supply_ma), longest_drive_(limits.longest_drive) {
  check(profile);
  motors_.reserve(profile.actuators.size());
  heaters_.reserve(profile.actuators.size());
  for (const Actuator& actuator : profile.actuators) {
    if (actuator.kind == ActuatorKind::motor) {
      all_.push_back(&motors_.emplace_back(actuator, profile, limits.max_strength));
    } else {
      all_.push_back(&heaters_.emplace_back(actuator, limits));
    }
  }
}

Outputs::Found Outputs::find(std::uint8_t id, double strength) {
  if (const auto motor = std::ranges::find(motors_, id, &Motor::id); motor != motors_.end()) {
    return {&*motor, static_cast<double>(motor->scale.intensity(strength))};
  }
  const auto heater = std::ranges::find(heaters_, id, &Heater::id);
  if (heater == heaters_.end()) return {};
  return {&*heater, set_point_celsius(strength, heater->most_celsius)};
}

Outputs::Asked Outputs::ask(SenderNumber sender, const Drive& wanted, const Permission& permission, Timestamp now) {
  const auto [output, level] = find(wanted.actuator, std::min(wanted.strength, 1.0) * permission.strength);
  if (output == nullptr) {
    ++counters_.refused_unknown_actuator;
    return Asked::refused;
  }
  const bool was_on = output->shares.any();
  output->shares.drop(sender);
  if (!output->enabled || is_muted(output->id, output->place, permission)) {
    ++counters_.refused_muted;
    return Asked::muted;
  }
  if (!std::isfinite(wanted.strength)) {
    ++counters_.refused_not_finite;
    return Asked::refused;
  }
  if (wanted.strength <= 0 || wanted.end <= now) {
    counters_.off_ended += one_if(was_on && !output->shares.any());
    return Asked::ended;
  }
  if (level <= 0) {
    ++counters_.refused_by_limit;
    return Asked::refused;
  }
  const Timestamp end = std::min(wanted.end, now + longest_drive_);
  output->shares.ask(sender, {level, end});
  ++counters_.drives_accepted;
  counters_.clamped_strength += one_if(wanted.strength > 1);
  counters_.clamped_end += one_if(end < wanted.end);
  return Asked::accepted;
}

void Outputs::pass(Timestamp now) {
  const auto ran = [this, now](const Output& output) {
    return output.given > 0 ? std::max(Duration{}, std::min(now, output.given_until) - passed_) : Duration{};
  };
  for (Motor& motor : motors_) {
    if (motor.given <= 0) continue;
    const double power = IntensityScale::power(static_cast<std::uint8_t>(motor.given));
    motor.duty.run(power / motor.max_power, ran(motor), now);
  }
  for (Heater& heater : heaters_) {
    const Duration heated = ran(heater);
    heater.supervision.pass(true, heated);
    heater.supervision.pass(false, now - passed_ - heated);
  }
  passed_ = now;
}

void Outputs::forget_time(Timestamp now) {
  silent(now);
  passed_ = now;
}

bool Outputs::expire(Timestamp now) {
  bool something_ended = false;
  for (Output* output : all_) {
    const bool ran = output->shares.any();
    something_ended = output->shares.expire(now) || something_ended;
    counters_.off_expired += one_if(ran && !output->shares.any());
  }
  return something_ended;
}

std::uint64_t Outputs::forget() {
  std::uint64_t ran = 0;
  for (Output* output : all_) {
    ran += one_if(output->shares.any());
    output->shares.clear();
    output->given = 0;
  }
  return ran;
}

void Outputs::forget_heaters() {
  for (Heater& heater : heaters_) {
    counters_.limited_by_heater += one_if(heater.given > 0);
    heater.shares.clear();
    heater.given = 0;
  }
}

bool Outputs::forget(SenderNumber sender, std::uint64_t& counter) {
  bool asked = false;
  for (Output* output : all_) {
    if (output->shares.drop(sender).level <= 0) continue;
    asked = true;
    counter += one_if(!output->shares.any());
  }
  return asked;
}

void Outputs::silent(Timestamp now) {
  for (Output* output : all_) {
    output->given = 0;
    output->silent_from = now;
  }
}

MotorCommands Outputs::motor_commands(const Vouched& vouched, Timestamp now) {
  pass(now);
  std::array<Share, motor_channels> wanted{};
  boost::container::static_vector<Draw, motor_channels> draws;
  for (std::size_t i = 0; i < motors_.size(); ++i) {
    Motor& motor = motors_[i];
    wanted.at(i) = motor.shares.strongest(now, vouched);
    const double power = IntensityScale::power(static_cast<std::uint8_t>(wanted.at(i).level));
    const double allowed = power > 0 ? std::min(power, motor.duty.most(now) * motor.max_power) : 0;
    counters_.limited_by_duty += one_if(allowed < power - rounding);
    draws.push_back({motor.scale.at_most(allowed) > 0 ? allowed : 0, motor.scale.least_power(), motor.full_ma});
  }
  const auto before = draws;
  fit_current({draws.data(), draws.size()}, supply_ma_);

  MotorCommands commands;
  for (std::size_t i = 0; i < motors_.size(); ++i) {
    Motor& motor = motors_[i];
    counters_.limited_by_current += one_if(draws[i].power < before[i].power);
    const std::uint8_t intensity = motor.scale.at_most(draws[i].power);
    const Timestamp end = wanted.at(i).end;
    motor.give(intensity, end);
    if (intensity > 0) {
      commands.push_back({motor.channel, intensity, end - now});
    } else if (motor.silent_from > now) {
      commands.push_back({motor.channel, 0, {}});
    }
  }
  return commands;
}

HeaterCommands Outputs::heater_commands(const Vouched& vouched, const std::optional<JacketTelemetry>& telemetry,
                                        Timestamp now) {
  pass(now);
  HeaterCommands commands;
  for (Heater& heater : heaters_) {
    const Share wanted = heater.shares.strongest(now, vouched);
    const bool may = heater.supervision.state(telemetry, now) == HeaterState::ready;
    counters_.limited_by_heater += one_if(wanted.level > 0 && !may);
    heater.give(may ? wanted.level : 0, wanted.end);
    if (heater.given > 0) {
      commands.push_back({heater.channel, heater.given, wanted.end - now});
    } else if (heater.silent_from > now) {
      commands.push_back({heater.channel, 0, {}});
    }
  }
  return commands;
}

bool Outputs::renewal_due(const Vouched& vouched, const std::optional<JacketTelemetry>& telemetry, Timestamp sent,
                          Timestamp now) const {
  const bool interval_over = now - sent >= renewal_interval;
  const bool runs_out = std::ranges::any_of(all_, [&](const Output* output) {
    if (!output->shares.any()) return interval_over && output->silent_from > now;
    const bool soon = output->given > 0 && output->silent_from - now <= renewal_margin;
    return interval_over || (soon && output->shares.strongest(now, vouched).end > output->silent_from);
  });
  return runs_out || std::ranges::any_of(heaters_, [&](const Heater& heater) {
           return heater.given > 0 && heater.supervision.state(telemetry, now) != HeaterState::ready;
         });
}

bool Outputs::asked() const noexcept {
  return std::ranges::any_of(all_, [](const Output* output) { return output->shares.any(); });
}

bool Outputs::runs(std::uint8_t id) const noexcept {
  return std::ranges::any_of(
      all_, [id](const Output* output) { return output->id == id && output->given > 0 && output->shares.any(); });
}

Refused Outputs::running() const {
  Refused ids;
  for (const Output* output : all_)
    if (runs(output->id)) ids.push_back(output->id);
  return ids;
}

DutyReports Outputs::duties(Timestamp now) {
  DutyReports reports;
  for (Motor& motor : motors_)
    reports.push_back({motor.id, motor.duty.used(now)});
  return reports;
}

HeaterReports Outputs::heaters(const std::optional<JacketTelemetry>& telemetry, Timestamp now) const {
  HeaterReports reports;
  for (const Heater& heater : heaters_) {
    const auto reading = heater.supervision.reading(telemetry, now).value_or(JacketTelemetry::Heater{});
    reports.push_back(
        {heater.id, heater.supervision.state(telemetry, now), reading.fault, heater.given, reading.celsius});
  }
  return reports;
}

}  // namespace telehug
