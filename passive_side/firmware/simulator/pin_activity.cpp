// SPDX-License-Identifier: Apache-2.0
#include "simulator/pin_activity.hpp"

namespace telehug {

void PinActivity::on_edge(const PinEdge& edge, std::int64_t now_ns) {
  Channel& channel = channels_.at(edge.channel);
  channel.high = edge.high;
  if (!edge.high) {
    channel.last_high_cycle = edge.cycle;
    channel.last_high_ns = now_ns;
  } else if (!channel.on) {
    channel.on = true;
    listener_({now_ns, edge.cycle, edge.channel, true});
  }
}

void PinActivity::advance(std::uint64_t cycle) {
  for (std::uint8_t i = 0; i < jacket_outputs; ++i) {
    Channel& channel = channels_.at(i);
    if (!channel.on || channel.high || cycle - channel.last_high_cycle <= quiet_cycles) continue;
    channel.on = false;
    listener_({channel.last_high_ns, channel.last_high_cycle, i, false});
  }
}

void PinActivity::end_all(std::uint64_t cycle, std::int64_t now_ns) {
  for (std::uint8_t i = 0; i < jacket_outputs; ++i) {
    if (channels_.at(i).high) on_edge({cycle, i, false}, now_ns);
  }
  advance(cycle + quiet_cycles + 1);
}

}  // namespace telehug
