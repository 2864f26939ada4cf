// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "common/clock.hpp"

namespace telehug {

// When a frame that drives something may leave: at most 50 in any second. Every 22 ms there is one, and up to four may
// be saved: 4 + 1000 / 22 < 50. (ITU-T I.371's generic cell rate algorithm.)
class DrivePace {
 public:
  static constexpr Duration interval = 20ms;  // between frames that only drive more or longer

  // The last saved one stays for a frame that turns something down.
  [[nodiscard]] bool may_drive(Timestamp now) const {
    return now - last_sent_ >= interval && owed_until_ - now <= 2 * allotment;
  }
  [[nodiscard]] bool may_lower(Timestamp now) const { return owed_until_ - now <= 3 * allotment; }

  void sent(Timestamp now) {
    last_sent_ = now;
    owed_until_ = std::max(owed_until_, now) + allotment;
  }

 private:
  static constexpr Duration allotment = 22ms;
  Timestamp last_sent_;
  Timestamp owed_until_;
};

}  // namespace telehug
