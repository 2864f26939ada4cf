// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <random>
#include <vector>

#include "common/clock.hpp"

namespace telehug {

// What befalls the packets of one direction. Probabilities are 0..1.
struct WayFaults {
  Duration delay{};
  Duration jitter{};     // added to the delay, evenly spread from 0; later packets may overtake earlier ones
  double loss = 0;       // 1: the way is cut
  double doubled = 0;    // delivered twice
  double held_back = 0;  // delivered this much later, so that others overtake them:
  Duration held_back_for = std::chrono::milliseconds(30);
};

// Decides when each packet arrives. Pure but for its seed.
class FaultyWay {
 public:
  explicit FaultyWay(std::uint32_t seed) : random_(seed) {}

  void set(const WayFaults& faults) { faults_ = faults; }

  // When a packet that enters now arrives: never, once or twice.
  [[nodiscard]] std::vector<Timestamp> arrivals(Timestamp now);

 private:
  [[nodiscard]] double chance() { return std::uniform_real_distribution<double>(0, 1)(random_); }

  std::mt19937 random_;
  WayFaults faults_;
};

}  // namespace telehug
