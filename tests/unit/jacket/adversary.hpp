// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <limits>
#include <random>

#include "doubles/fake_jacket_link.hpp"
#include "safety/consent.hpp"
#include "safety/safety_values.hpp"
#include "unit/jacket/jacket_builders.hpp"

namespace telehug {

// Makes whatever can come in, and what can't. The same seed gives the same.
class Adversary {
 public:
  explicit Adversary(std::uint32_t seed) : random_(seed) {}

  int whole(int least, int most) { return std::uniform_int_distribution(least, most)(random_); }
  double real(double least, double most) { return std::uniform_real_distribution(least, most)(random_); }
  bool one_in(int n) { return whole(1, n) == 1; }

  // Now and then one that there can't be.
  SenderNumber sender() { return static_cast<SenderNumber>(one_in(20) ? whole(0, 255) : whole(0, 2)); }
  double strength() {
    static constexpr double odd[]{std::numeric_limits<double>::quiet_NaN(),
                                  std::numeric_limits<double>::infinity(),
                                  -std::numeric_limits<double>::infinity(),
                                  -1,
                                  0,
                                  1e-300,
                                  1,
                                  1e300};
    return one_in(3) ? odd[whole(0, 7)] : real(-0.2, 1.4);
  }
  Timestamp end(Timestamp now) {
    static const Timestamp odd[]{Timestamp::min(), Timestamp{}, now, Timestamp::max()};
    return one_in(4) ? odd[whole(0, 3)] : now + std::chrono::milliseconds(whole(-100, 3000));
  }
  Drives drives(Timestamp now) {
    Drives made;
    for (int n = whole(0, one_in(10) ? 32 : 4); n > 0; --n) {
      made.push_back({static_cast<std::uint8_t>(one_in(8) ? whole(0, 255) : whole(1, 10)), strength(), end(now)});
    }
    return made;
  }
  Contact contact() {
    static constexpr double odd[]{std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                                  -1e300, 1e300};
    Contact made = contact_in(whole(1, 20), static_cast<std::uint32_t>(whole(1, 4)), static_cast<Phase>(whole(0, 2)));
    made.strength = strength();
    if (one_in(4)) made.box = static_cast<std::uint16_t>(whole(0, 65535));
    if (one_in(4))
      made.grid = {static_cast<std::uint16_t>(whole(0, 65535)), static_cast<std::uint16_t>(whole(0, 65535))};
    if (one_in(4)) made.body.x_fh = odd[whole(0, 3)];
    if (one_in(4)) made.body.y_fh = odd[whole(0, 3)];
    return made;
  }
  std::int64_t frame_time_ns() {
    static constexpr std::int64_t odd[]{std::numeric_limits<std::int64_t>::min(), 0,
                                        std::numeric_limits<std::int64_t>::max()};
    return one_in(10) ? odd[whole(0, 2)] : whole(0, 1'000'000'000);
  }
  Consent consent(std::chrono::sys_seconds now) {
    Consent made;
    if (one_in(5)) made.pause = Pause{};
    if (made.pause && one_in(2)) made.pause->until = now + std::chrono::seconds(whole(-5, 5));
    for (int n = one_in(3) ? whole(1, 3) : 0; n > 0; --n)
      made.quiet_hours.push_back({whole(0, minutes_of_day - 1), whole(0, minutes_of_day - 1)});
    for (int n = one_in(2) ? whole(1, 3) : 0; n > 0; --n)
      made.muted_actuators.set(static_cast<std::size_t>(whole(0, 10)));
    for (int n = one_in(2) ? whole(1, 6) : 0; n > 0; --n)
      made.muted_boxes.set(static_cast<std::size_t>(whole(1, 20)));
    if (one_in(5)) made.strength = real(0, 1);
    return made;
  }
  std::optional<JacketTelemetry> telemetry(Timestamp now) {
    static constexpr double odd[]{std::numeric_limits<double>::quiet_NaN(), -1e300, 41, 1e300};
    if (one_in(10)) return std::nullopt;
    JacketTelemetry told;
    told.heard = one_in(6) ? now + std::chrono::milliseconds(whole(-5000, 5000)) : now;
    for (int n = one_in(8) ? whole(0, 2) : 2; n > 0; --n) {
      auto& heater = told.heaters.emplace_back();
      if (!one_in(10)) heater.celsius = one_in(10) ? odd[whole(0, 3)] : real(15, 40);
      if (one_in(10)) heater.fault = static_cast<protocol::HeaterFault>(whole(0, 6));
    }
    return told;
  }
  TouchEvent event() {
    TouchEvent made;
    made.sequence = static_cast<std::uint64_t>(whole(0, 20));
    made.frame_time_ns = frame_time_ns();
    for (int n = whole(0, static_cast<int>(max_contacts)); n > 0; --n)
      made.contacts.push_back(contact());
    for (int n = whole(0, static_cast<int>(max_transitions)); n > 0; --n) {
      made.transitions.push_back({static_cast<std::uint64_t>(whole(0, 20)), frame_time_ns(), contact()});
    }
    return made;
  }

 private:
  std::mt19937 random_;
};

inline JacketProfile random_profile(Adversary& adversary) {
  JacketProfile profile = profile_of({}, adversary.one_in(2) ? Uncovered::nearest : Uncovered::none);
  if (adversary.one_in(2)) profile.rendering = Rendering::places;
  for (int id = 1; id <= 8; ++id) {
    Actuator made = motor(static_cast<std::uint8_t>(id), {}, {});
    made.channel = static_cast<std::uint8_t>(15 - id);
    made.place = {adversary.real(-1, 1), adversary.real(0, 2)};
    for (int n = adversary.whole(0, 3); n > 0; --n) {
      made.boxes.push_back(static_cast<std::uint16_t>(adversary.whole(1, 20)));
    }
    made.max_strength = adversary.real(0, 1);
    made.min_strength = adversary.real(0, made.max_strength);
    made.gamma = adversary.real(0.2, 5);
    made.kick = std::chrono::milliseconds(adversary.whole(0, 100));
    made.enabled = !adversary.one_in(10);
    if (adversary.one_in(2)) made.max_duty = adversary.real(0.01, 1);
    if (!adversary.one_in(4)) made.current_ma = adversary.real(0, 120);
    profile.actuators.push_back(made);
  }
  for (int heater = 0; heater < 2; ++heater) {
    Actuator made = motor(static_cast<std::uint8_t>(9 + heater), {}, {});
    made.kind = ActuatorKind::heater;
    made.channel = static_cast<std::uint8_t>(heater);
    made.place = {adversary.real(-1, 1), adversary.real(0, 2)};
    made.max_celsius = adversary.real(32, 45);
    made.enabled = !adversary.one_in(10);
    profile.actuators.push_back(made);
  }
  if (adversary.one_in(2)) profile.supply_ma = adversary.real(1, 120);
  profile.duty_window = std::chrono::milliseconds(adversary.whole(1, 3000));
  return profile;
}

}  // namespace telehug
