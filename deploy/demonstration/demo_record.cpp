// SPDX-License-Identifier: Apache-2.0
#include "demo_record.hpp"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <stdexcept>

namespace telehug {

void DemoRecord::add(const nlohmann::json& event) {
  const std::string kind = event.value("event", "");
  const std::string side = event.value("side", "");
  if (kind == "dropped") dropped_events += event.value("count", 0U);
  if (kind == "touch" && side == "active") {
    published.push_back({event.at("event_sequence"),
                         event.at("frame"),
                         event.at("frame_time_ns"),
                         event.at("contact"),
                         event.at("phase"),
                         event.at("box"),
                         {event.at("x_mm"), event.at("y_mm")}});
  }
  if (kind == "felt" && side == "passive") {
    FeltAnswer answer{event.at("contact"), event.at("phase"), event.at("box"), event.at("outcome"), {}};
    for (const auto& id : event.at("actuators"))
      answer.actuators.push_back(id);
    std::ranges::sort(answer.actuators);
    felt.push_back(std::move(answer));
  }
}

std::vector<PinChange> read_pins(const std::filesystem::path& log) {
  std::ifstream file(log);
  if (!file) throw std::runtime_error("the simulated jacket left no log of its pins at " + log.string());
  std::vector<PinChange> changes;
  for (std::string line; std::getline(file, line);) {
    long long time_ns = 0;
    long long cycle = 0;
    int channel = 0;
    std::array<char, 4> state{};
    if (std::sscanf(line.c_str(), "%lld,%lld,%d,%3[onf]", &time_ns, &cycle, &channel, state.data()) != 4) continue;
    changes.push_back({time_ns, channel, std::string(state.data()) == "on"});
  }
  return changes;
}

}  // namespace telehug
