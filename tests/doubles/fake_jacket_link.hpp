// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "link/jacket_link.hpp"

namespace telehug {

// The jacket at the other end of a FakeJacketLink: records what reaches it and does with it what the microcontroller
// does (a motor runs for the duration of its command, 250 ms at most). Outlives the link, so that a test sees its end.
struct FakeJacket {
  struct Frame {
    Timestamp time;
    MotorCommands commands;
  };
  struct Motor {
    std::uint8_t intensity = 0;
    Timestamp end;
  };
  struct HeatFrame {
    Timestamp time;
    HeaterCommands commands;
  };
  struct Heater {
    double celsius = 0;
    Timestamp end;
  };

  LinkStatus status{.state = LinkState::armed, .device = "fake", .problem = {}, .motor_count = 16, .heater_count = 2};
  bool loses_frames = false;                // send() succeeds, the jacket hears nothing
  bool accepts_frames = true;               // send() fails otherwise
  LinkState next_state = LinkState::armed;  // taken over by the next poll()
  std::vector<Frame> frames;
  std::array<Motor, 16> motors{};
  std::vector<HeatFrame> heat_frames;
  std::array<Heater, 2> heaters{};
  std::size_t stops = 0;
  struct Stop {
    Timestamp time;
    std::size_t after_frames;  // how many had left before
  };
  std::vector<Stop> stop_log;
  std::size_t polls = 0;

  [[nodiscard]] std::uint8_t intensity(std::size_t channel, Timestamp now) const {
    return motors.at(channel).end > now ? motors.at(channel).intensity : std::uint8_t{0};
  }
  // What the heater is to keep; 0: it is off.
  [[nodiscard]] double celsius(std::size_t heater, Timestamp now) const {
    return heaters.at(heater).end > now ? heaters.at(heater).celsius : 0;
  }
  [[nodiscard]] std::vector<int> running(Timestamp now) const {
    std::vector<int> channels;
    for (std::size_t channel = 0; channel < motors.size(); ++channel) {
      if (intensity(channel, now) > 0) channels.push_back(static_cast<int>(channel));
    }
    return channels;
  }
};

class FakeJacketLink final : public JacketLink {
 public:
  explicit FakeJacketLink(FakeJacket& jacket) : jacket_(jacket) {}

  void poll(Timestamp) override {
    ++jacket_.polls;
    if (jacket_.next_state == LinkState::armed && jacket_.status.state != LinkState::armed) {
      ++jacket_.status.reconnects;
      jacket_.motors = {};  // the firmware starts anew with everything off
      jacket_.heaters = {};
    }
    jacket_.status.state = jacket_.next_state;
  }

  bool send(const MotorCommands& commands, Timestamp now) override {
    if (jacket_.status.state != LinkState::armed || !jacket_.accepts_frames) return false;
    jacket_.frames.push_back({now, commands});
    if (jacket_.loses_frames) return true;
    for (const MotorCommand& command : commands) {
      jacket_.motors.at(command.channel) = {command.intensity,
                                            now + std::clamp(command.duration, Duration{}, Duration{250ms})};
    }
    return true;
  }

  // As the links: none where the jacket has none, nothing above 40 C.
  bool heat(const HeaterCommands& commands, Timestamp now) override {
    if (jacket_.status.state != LinkState::armed || !jacket_.accepts_frames || jacket_.status.heater_count == 0) {
      return false;
    }
    if (!std::ranges::all_of(commands, [](const auto& command) { return command.celsius <= 40; })) return false;
    jacket_.heat_frames.push_back({now, commands});
    if (jacket_.loses_frames) return true;
    for (const HeaterCommand& command : commands) {
      jacket_.heaters.at(command.heater) = {command.celsius,
                                            now + std::clamp(command.duration, Duration{}, Duration{250ms})};
    }
    return true;
  }

  void stop_all(Timestamp now) override {
    ++jacket_.stops;
    jacket_.stop_log.push_back({now, jacket_.frames.size()});
    if (jacket_.loses_frames || jacket_.status.state != LinkState::armed) return;
    jacket_.motors = {};
    jacket_.heaters = {};
  }

  [[nodiscard]] const LinkStatus& status() const override { return jacket_.status; }

 private:
  FakeJacket& jacket_;
};

}  // namespace telehug
