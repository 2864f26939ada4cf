// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gmock/gmock.h>

#include <memory>
#include <optional>
#include <vector>

#include "doubles/fake_jacket_link.hpp"
#include "safety/safety_stage.hpp"
#include "unit/jacket/jacket_builders.hpp"

namespace telehug {

// Three motors on channels 0, 1, 2; the second is weak.
inline JacketProfile three_motors() {
  JacketProfile profile = profile_of({motor(1, {}, {1}), motor(2, {}, {2}), motor(3, {}, {3})});
  profile.actuators[1].max_strength = 0.4;
  profile.actuators[1].min_strength = 0.2;
  return profile;
}

class SafetyStageTest : public ::testing::Test {
 protected:
  SafetyStageTest() { start({}); }

  void start(SafetyLimits limits, const JacketProfile& profile = three_motors()) {
    safety.reset();
    safety.emplace(std::make_unique<FakeJacketLink>(jacket), profile, limits);
    safety->tick(now);
    safety->on_heartbeat(0, now);
    jacket.stops = 0;
  }
  FeltOutcome drive(std::uint8_t actuator, double strength = 1, Duration duration = 200ms) {
    return safety->apply(0, {{actuator, strength, now + duration}}, now).outcome;
  }
  // The sender's heartbeat every 100 ms, a tick every 10 ms.
  void live(Duration duration) {
    for (Duration passed{}; passed < duration; passed += 10ms) {
      now += 10ms;
      if ((now - start_time) % 100ms == 0ms) safety->on_heartbeat(0, now);
      safety->tick(now);
    }
  }
  // Ticks, but not a word from the sender.
  void live_without_sender(Duration duration) {
    for (Duration passed{}; passed < duration; passed += 10ms) {
      now += 10ms;
      safety->tick(now);
    }
  }
  [[nodiscard]] std::vector<int> running() const { return jacket.running(now); }
  [[nodiscard]] int intensity(std::size_t channel) const { return jacket.intensity(channel, now); }

  const Timestamp start_time = from_ns(1'000'000'000);
  Timestamp now = start_time;
  FakeJacket jacket;
  std::optional<SafetyStage> safety;
};

}  // namespace telehug
