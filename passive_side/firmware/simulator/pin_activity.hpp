// SPDX-License-Identifier: Apache-2.0
//
// From the edges of pins that are modulated (about 1 kHz) to motors and heaters that run or don't.
#pragma once

#include <array>
#include <cstdint>
#include <functional>

#include "simulator/simulated_jacket.hpp"

namespace telehug {

// A channel starts with a rising edge. It has ended when its pin stayed low for 3 ms of simulated time, and ended at
// the last high level before.
struct ActivityChange {
  std::int64_t monotonic_ns = 0;
  std::uint64_t cycle = 0;
  std::uint8_t channel = 0;
  bool on = false;
};

class PinActivity {
 public:
  using Listener = std::function<void(const ActivityChange&)>;
  static constexpr std::uint64_t quiet_cycles = 3 * jacket_cycles_per_ms;

  explicit PinActivity(Listener listener) : listener_(std::move(listener)) {}

  // `now_ns`: the real time to note beside the edge's cycle.
  void on_edge(const PinEdge& edge, std::int64_t now_ns);
  // Reports the channels that have been quiet for long enough at `cycle`.
  void advance(std::uint64_t cycle);
  // Power is gone: everything ends now.
  void end_all(std::uint64_t cycle, std::int64_t now_ns);

  [[nodiscard]] bool is_on(std::uint8_t channel) const { return channels_.at(channel).on; }

 private:
  struct Channel {
    bool on = false;
    bool high = false;
    std::uint64_t last_high_cycle = 0;
    std::int64_t last_high_ns = 0;
  };
  Listener listener_;
  std::array<Channel, jacket_outputs> channels_{};
};

}  // namespace telehug
