// SPDX-License-Identifier: Apache-2.0
#include "feedback/felt_pulse.hpp"

namespace telehug {
namespace {

// A coin motor needs 50 to 100 ms to turn up: shorter pulses would not be felt.
constexpr Duration firm_pulse = 120ms;
constexpr Duration light_pulse = 80ms;
constexpr double light = 0.6;  // of the firm one's strength

}  // namespace

std::optional<Drives> felt_pulse(const Felt& felt, const JacketProfile& profile, double strength, Timestamp now) {
  if (felt.outcome != FeltOutcome::driven || felt.phase == Phase::up) return std::nullopt;
  const bool begins = felt.phase == Phase::down;
  Drives drives;
  for (const Actuator& actuator : profile.actuators) {
    if (actuator.kind != ActuatorKind::motor || !actuator.enabled) continue;
    drives.push_back({actuator.id, begins ? strength : light * strength, now + (begins ? firm_pulse : light_pulse)});
  }
  return drives;
}

}  // namespace telehug
