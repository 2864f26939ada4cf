// SPDX-License-Identifier: Apache-2.0
#include "netlab/faulty_way.hpp"

namespace telehug {

std::vector<Timestamp> FaultyWay::arrivals(Timestamp now) {
  std::vector<Timestamp> result;
  if (chance() < faults_.loss) return result;
  const int copies = chance() < faults_.doubled ? 2 : 1;
  for (int i = 0; i < copies; ++i) {
    Timestamp arrival = now + faults_.delay + std::chrono::duration_cast<Duration>(faults_.jitter * chance());
    if (chance() < faults_.held_back) arrival += faults_.held_back_for;
    result.push_back(arrival);
  }
  return result;
}

}  // namespace telehug
