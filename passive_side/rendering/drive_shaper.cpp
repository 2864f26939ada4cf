// SPDX-License-Identifier: Apache-2.0
#include "rendering/drive_shaper.hpp"

#include <algorithm>
#include <cmath>

namespace telehug {
namespace {

// A motor that was off for less still turns, and needs no kick.
constexpr Duration coasting = 100ms;
// A kick ends when the next round says so; if that is late, a little later by itself.
constexpr Duration kick_margin = 20ms;
// Half of a step of the microcontroller.
constexpr double slightest = 1 / 62.0;

}  // namespace

void DriveShaper::want(double strength, Timestamp end, Timestamp now) {
  starts_ = false;
  wanted_ = {actuator_->id, 0, now};
  if (!(strength > 0) || end <= now) return;
  if (actuator_->kind == ActuatorKind::heater) {
    wanted_ = {actuator_->id, std::min(strength, 1.0), end};
    return;
  }
  const Timestamp off_since = told_.strength > 0 ? told_.end : stopped_.value_or(now - coasting);
  if (!runs(now)) kick_ends_ = now - off_since >= coasting ? now + actuator_->kick : now;
  wanted_ = {actuator_->id, std::pow(std::min(strength, 1.0), actuator_->gamma), end};
  starts_ = now < kick_ends_ && wanted_.strength < 1 - slightest;
  if (starts_) wanted_ = {actuator_->id, 1, std::min(end, kick_ends_ + kick_margin)};
}

bool DriveShaper::runs(Timestamp now) const noexcept {
  return told_.strength > 0 && told_.end > now;
}

std::optional<Drive> DriveShaper::state(Timestamp now) const {
  if (on() || runs(now)) return wanted_;
  return std::nullopt;
}

DriveShaper::News DriveShaper::news(Timestamp now) const {
  if (on() != runs(now) || told_start_ != starts_) return News::urgent;
  const bool other = std::abs(wanted_.strength - told_.strength) > slightest || wanted_.end > told_.end;
  return on() && other ? News::slight : News::none;
}

void DriveShaper::told(Timestamp now) {
  if (!on() && told_.strength > 0) stopped_ = std::min(now, told_.end);
  told_ = wanted_;
  told_start_ = starts_;
}

void DriveShaper::forget() noexcept {
  wanted_ = told_ = {};
  starts_ = told_start_ = false;
  stopped_.reset();
}

}  // namespace telehug
