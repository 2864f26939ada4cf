// SPDX-License-Identifier: Apache-2.0
// Touches and jackets for tests of how touches are felt.
#pragma once

#include <fmt/format.h>

#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "rendering/jacket_renderer.hpp"
#include "unit/jacket/jacket_builders.hpp"

namespace telehug {

inline JacketProfile places_of(std::vector<Actuator> actuators, Uncovered uncovered = Uncovered::none) {
  JacketProfile made = profile_of(std::move(actuators), uncovered);
  made.rendering = Rendering::places;
  return made;
}

inline Actuator heater(std::uint8_t id, BodyPoint place, BodySide side = BodySide::front) {
  Actuator made = motor(id, place, {});
  made.kind = ActuatorKind::heater;
  made.channel = 0;
  made.side = side;
  return made;
}

// Five motors in a row across the chest, half a face height apart: ids 1 to 5 from the left of the screen.
inline std::vector<Actuator> row_of_motors() {
  std::vector<Actuator> row;
  for (int i = 0; i < 5; ++i)
    row.push_back(motor(static_cast<std::uint8_t>(i + 1), {(i - 2) * 0.5, 1}, {}));
  return row;
}

inline Contact contact_at(BodyPoint place, Gesture gesture = Gesture::none, Phase phase = Phase::down) {
  Contact made = contact_in(8, 1, phase);
  made.body = place;
  made.gesture = gesture;
  return made;
}

// A jacket that does what it is told, on a clock that goes on by rounds of the drive thread: what each actuator runs
// at, and what it was told at which time.
class ObedientJacket {
 public:
  static constexpr Timestamp start = from_ns(5'000'000'000);
  static constexpr Duration hold = 200ms;
  static constexpr Duration round = 10ms;

  explicit ObedientJacket(JacketProfile its_profile) : profile(std::move(its_profile)) {}

  // The sender's next event.
  const JacketPlan& feel(const std::vector<Contact>& contacts, const std::vector<Transition>& fresh = {}) {
    const TouchEvent event = event_of(++sequence, contacts);
    const JacketPlan& plan = renderer.plan(event, fresh, now);
    obey(plan.drives);
    return plan;
  }
  const JacketPlan& feel(const Contact& contact) { return feel(std::vector{contact}); }

  // Time goes on without an event.
  void pass(Duration time) {
    for (Duration passed{}; passed < time; passed += round) {
      now += round;
      obey(renderer.tick(now));
      if (watch) watch();
    }
  }

  // Time goes on with an event every `interval` that tells the same.
  void rest(const Contact& contact, Duration time, Duration interval = 30ms) {
    Contact resting = contact;
    resting.phase = Phase::move;
    for (Duration passed{}; passed < time; passed += interval) {
      pass(interval);
      feel(resting);
    }
  }

  [[nodiscard]] double strength(std::uint8_t id) const {
    const auto drive = told.find(id);
    return drive != told.end() && drive->second.end > now ? drive->second.strength : 0;
  }
  [[nodiscard]] std::vector<int> running() const {
    std::vector<int> ids;
    for (const auto& [id, drive] : told)
      if (strength(id) > 0) ids.push_back(id);
    return ids;
  }

  JacketProfile profile;
  JacketRenderer renderer{profile, hold};
  Timestamp now = start;
  std::uint64_t sequence = 0;
  std::map<std::uint8_t, Drive> told;
  std::size_t commands = 0;     // how often it was told anything
  std::string log;              // a line each time: ms, then id=strength-ms of its end
  std::function<void()> watch;  // called after every round

 private:
  void obey(const Drives& drives) {
    if (drives.empty()) return;
    ++commands;
    log += fmt::format("{:.0f}:", to_ms(now - start));
    for (const Drive& drive : drives) {
      told[drive.actuator] = drive;
      log += fmt::format(" {}={:.2f}", drive.actuator, drive.strength);
      if (drive.strength > 0) log += fmt::format("-{:.0f}", to_ms(drive.end - start));
    }
    log += '\n';
  }
};

}  // namespace telehug
