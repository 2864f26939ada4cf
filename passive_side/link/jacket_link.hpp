// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/container/static_vector.hpp>
#include <cstdint>
#include <optional>
#include <string>

#include "common/clock.hpp"
#include "link/protocol.hpp"

namespace telehug {

// What one motor of the jacket is to do now. The microcontroller turns it off by itself after `duration`.
struct MotorCommand {
  std::uint8_t channel = 0;    // of the microcontroller, 0..15
  std::uint8_t intensity = 0;  // 0 off .. 255 full
  Duration duration{};         // clamped to 250 ms by the microcontroller
};

using MotorCommands = boost::container::static_vector<MotorCommand, protocol::motor_count>;

// Likewise of a heater: how warm the microcontroller is to keep it, by its own sensor and its own rules.
struct HeaterCommand {
  std::uint8_t heater = 0;  // of the microcontroller, 0..1
  double celsius = 0;       // at most 40; 0: off
  Duration duration{};      // clamped to 250 ms by the microcontroller
};

using HeaterCommands = boost::container::static_vector<HeaterCommand, protocol::heater_count>;

// What the microcontroller last told of itself.
struct JacketTelemetry {
  Timestamp heard;
  double supply_volts = 0;       // 0: it does not measure it
  std::uint8_t reset_cause = 0;  // MCUSR; words for it in jacket_telemetry.hpp
  std::uint16_t frames_malformed = 0;
  std::uint16_t bytes_overrun = 0;
  struct Heater {
    std::optional<double> celsius;                              // empty: no valid reading
    protocol::HeaterFault fault = protocol::HeaterFault::none;  // may be one that the enumeration lacks
  };
  boost::container::static_vector<Heater, protocol::heater_count> heaters;
};

enum class LinkState { absent, connecting, armed };

struct LinkStatus {
  LinkState state = LinkState::absent;
  std::string device;        // path or name of what it talks to
  std::string problem;       // one sentence; empty when armed
  bool answers = true;       // false: a legacy jacket; armed then only means that there is a wire to it
  int firmware_version = 0;  // 0: unknown
  int motor_count = 0;
  int heater_count = 0;  // those with a sensor
  std::optional<JacketTelemetry> telemetry{};
  std::uint64_t reconnects = 0;
  std::uint64_t frames_sent = 0;
  std::uint64_t frames_received = 0;
  std::uint64_t malformed_frames = 0;  // received: bad COBS, CRC, type or length
  std::uint64_t nacks = 0;
};

// The wire to the microcontroller. Only the safety stage holds one. One thread uses a link; nothing here blocks.
class JacketLink {
 public:
  virtual ~JacketLink() = default;

  // Connects, shakes hands, keeps alive, reads answers, reconnects. Call it often (at least every 20 ms).
  virtual void poll(Timestamp now) = 0;

  // Sends the newest state; returns false (and forgets it) when the jacket is not armed. Never queues.
  virtual bool send(const MotorCommands& commands, Timestamp now) = 0;

  // Likewise for heaters; other heaters go on as they are. False also where the jacket has none, and where one is to
  // get warmer than 40 C (then nothing of it is sent).
  virtual bool heat(const HeaterCommands& commands, Timestamp now) = 0;

  // Everything off. Sent ahead of all else; repeated by poll() until it has left.
  virtual void stop_all(Timestamp now) = 0;

  [[nodiscard]] virtual const LinkStatus& status() const = 0;
};

}  // namespace telehug
