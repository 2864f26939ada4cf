// SPDX-License-Identifier: Apache-2.0
//
// What happened during a demo, as the daemons and the jacket's pins told it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "common/units.hpp"

namespace telehug {

// One contact of a published event.
struct PublishedTouch {
  std::uint64_t event_sequence = 0;
  std::uint64_t frame = 0;
  std::int64_t frame_time_ns = 0;
  std::uint32_t contact = 0;
  std::string phase;  // down, move, up
  int box = 0;
  ScreenPoint screen;
};

struct FeltAnswer {
  std::uint32_t contact = 0;
  std::string phase;
  int box = 0;
  std::string outcome;
  std::vector<int> actuators;  // ids, rising
};

// A motor's pin of the simulated microcontroller started or stopped.
struct PinChange {
  std::int64_t time_ns = 0;
  int channel = 0;
  bool on = false;
};

struct DemoRecord {
  std::vector<PublishedTouch> published;
  std::vector<FeltAnswer> felt;  // as the wearer's side answered
  std::vector<PinChange> pins;
  std::uint64_t dropped_events = 0;  // not told, because this program read too slowly
  // Touches that begin later are cut short by the demo's own end and need not be felt.
  std::int64_t judged_until_ns = std::numeric_limits<std::int64_t>::max();

  // Adds an event of a daemon's `watch`; others than those above are ignored.
  void add(const nlohmann::json& event);
};

// The log of telehug-jacket-sim --pins. Throws std::runtime_error if it can't be read.
std::vector<PinChange> read_pins(const std::filesystem::path& log);

}  // namespace telehug
