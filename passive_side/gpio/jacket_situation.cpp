// SPDX-License-Identifier: Apache-2.0
#include "gpio/jacket_situation.hpp"

namespace telehug {

LightPattern light_pattern(const JacketSituation& now) noexcept {
  if (now.stopped || now.problem || !now.armed) return LightPattern::fast_blink;
  if (!now.sender) return LightPattern::slow_blink;
  return now.touched ? LightPattern::double_blink : LightPattern::steady;
}

bool light_on(LightPattern pattern, Duration time) noexcept {
  switch (pattern) {
    case LightPattern::fast_blink:
      return time % 200ms < 100ms;
    case LightPattern::double_blink:
      return time % 1s < 100ms || (time % 1s >= 200ms && time % 1s < 300ms);
    case LightPattern::slow_blink:
      return time % 2s < 200ms;
    case LightPattern::steady:
      return true;
  }
  return false;
}

}  // namespace telehug
