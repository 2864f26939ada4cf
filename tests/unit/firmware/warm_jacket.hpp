// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "unit/firmware/virtual_jacket.hpp"

namespace telehug {

// The jacket with heaters on a wearer, in virtual time. Whatever a test does, a heater's pin is high only while the
// jacket is armed, within 250 ms of a HEAT for it, and while its sensor has at most 41 C.
class WarmJacket : public VirtualJacket {
 public:
  static constexpr std::size_t heaters = 2;
  using Celsius = std::array<double, heaters>;
  struct HeaterTelemetry {
    double celsius = 0;  // NaN: none
    protocol::HeaterFault fault{};
  };

  WarmJacket() : VirtualJacket(*find_board("motors12_heaters2")) { run_ms(300); }

  [[nodiscard]] static FramePayload heat_payload(std::uint8_t heater, double celsius, std::uint8_t duration_10ms = 25) {
    const auto decidegrees = static_cast<unsigned>(std::lround(celsius * 10));
    return {heater, static_cast<std::uint8_t>(decidegrees & 0xFF), static_cast<std::uint8_t>(decidegrees >> 8),
            duration_10ms};
  }
  std::optional<Frame> heat(std::uint8_t heater, double celsius, std::uint8_t duration_10ms = 25) {
    heated_at.at(heater) = not_yet;
    const auto answer = ask(protocol::FrameType::heat, heat_payload(heater, celsius, duration_10ms));
    heated_at.at(heater) = chip.cycle();
    check();
    return answer;
  }

  // Says once what the heaters are to hold for the next 250 ms; 0: as they are.
  void hold(Celsius wanted) {
    FramePayload payload;
    for (std::uint8_t heater = 0; heater < heaters; ++heater) {
      if (wanted.at(heater) == 0) continue;
      const FramePayload entry = heat_payload(heater, wanted.at(heater));
      payload.insert(payload.end(), entry.begin(), entry.end());
      heated_at.at(heater) = not_yet;
    }
    const auto said = say(payload.empty() ? protocol::FrameType::keep : protocol::FrameType::heat, payload);
    for (std::uint64_t& cycle : heated_at) {
      if (cycle == not_yet) cycle = said;
    }
  }

  // Runs while saying every 200 ms what the heaters are to hold.
  void run_heated_s(double seconds, Celsius wanted) {
    (void)ms_until([] { return false; }, wanted, seconds);
  }

  void run_ms(std::uint64_t ms) {
    for (std::uint64_t i = 0; i < ms; ++i) {
      chip.run_ms(1);
      check();
    }
  }

  // The same until it holds, and how long that took; nothing if it takes longer than `limit_s`.
  template <typename Condition>
  std::optional<double> ms_until(Condition condition, Celsius wanted, double limit_s) {
    const auto from = chip.cycle();
    for (;;) {
      hold(wanted);
      for (int ms = 0; ms < 190; ++ms) {
        if (condition()) return to_ms(chip.cycle() - from);
        if (to_ms(chip.cycle() - from) >= 1000 * limit_s) return std::nullopt;
        run_ms(1);
      }
    }
  }

  HeaterTelemetry heater_telemetry(std::uint8_t heater) {
    (void)hear(5);  // answers that are still on the way
    const auto answer = ask(protocol::FrameType::status).value();
    const std::size_t at = protocol::telemetry_bytes + std::size_t{heater} * protocol::temperature_bytes;
    const auto decidegrees = static_cast<std::int16_t>(answer.payload.at(at) | answer.payload.at(at + 1) << 8);
    const bool none = decidegrees == protocol::no_temperature;
    return {none ? std::nan("") : decidegrees / 10.0, static_cast<protocol::HeaterFault>(answer.payload.at(at + 2))};
  }

  [[nodiscard]] bool is_heating(std::uint8_t heater) const {
    return chip.is_high(static_cast<std::uint8_t>(first_heater_channel + heater));
  }
  [[nodiscard]] double pad(std::uint8_t heater) { return chip.heaters().patch(heater).pad_celsius(); }
  void break_now(std::uint8_t heater, HeaterBreak what) { chip.heaters().break_at(chip.cycle(), heater, what); }

  Celsius warmest_pad{};

 private:
  static constexpr std::uint64_t not_yet = std::numeric_limits<std::uint64_t>::max();  // the frame is on the way

  void check() {
    for (std::uint8_t i = 0; i < heaters; ++i) {
      const HeatedPatch& patch = chip.heaters().patch(i);
      warmest_pad.at(i) = std::max(warmest_pad.at(i), patch.pad_celsius());
      if (!is_heating(i)) continue;
      EXPECT_LE(patch.sensor_celsius(), 41.0);
      EXPECT_TRUE(chip.armed_led());
      const std::uint64_t since = std::min(heated_at.at(i), chip.cycle());
      EXPECT_LE(to_ms(chip.cycle() - since), 250.0);
    }
  }

  std::array<std::uint64_t, heaters> heated_at{};
};

}  // namespace telehug
