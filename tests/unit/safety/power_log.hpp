// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <deque>

#include "doubles/fake_jacket_link.hpp"

namespace telehug {

// What the microcontroller makes of an intensity (passive_side/firmware/motors.cpp): the nearest of 31 steps.
inline double power_at_pin(std::uint8_t intensity) {
  return (intensity * 31 + 127) / 255 / 31.0;
}

// What each motor was commanded to do and when, from the frames and stops that left for the jacket.
class PowerLog {
 public:
  void command(const FakeJacket::Frame& frame) {
    for (const MotorCommand& command : frame.commands) {
      auto& spans = spans_.at(command.channel);
      if (!spans.empty()) spans.back().end = std::min(spans.back().end, frame.time);
      if (command.intensity == 0) continue;
      spans.push_back({frame.time, frame.time + command.duration, power_at_pin(command.intensity)});
    }
  }
  void stop(Timestamp time) {
    for (auto& spans : spans_)
      if (!spans.empty()) spans.back().end = std::min(spans.back().end, time);
  }
  void forget() { spans_ = {}; }

  // 0..1 of full.
  [[nodiscard]] double power(std::size_t channel, Timestamp now) const {
    const auto& spans = spans_.at(channel);
    const bool runs = !spans.empty() && spans.back().begin <= now && spans.back().end > now;
    return runs ? spans.back().power : 0;
  }

  // Seconds at full power within the window that ends now.
  [[nodiscard]] double used_s(std::size_t channel, Duration window, Timestamp now) const {
    double sum = 0;
    for (const Span& span : spans_.at(channel)) {
      const auto within = std::min(span.end, now) - std::max(span.begin, now - window);
      if (within > Duration{}) sum += span.power * std::chrono::duration<double>(within).count();
    }
    return sum;
  }

 private:
  struct Span {
    Timestamp begin;
    Timestamp end;
    double power;
  };
  std::array<std::deque<Span>, 16> spans_;
};

}  // namespace telehug
