// SPDX-License-Identifier: Apache-2.0
//
// How sources that are no device keep to the clock.
#pragma once

#include <algorithm>
#include <functional>
#include <optional>
#include <thread>

#include "common/clock.hpp"

namespace telehug {

// Sleeps until a time of the Clock. Tests give one that moves their fake clock.
using SleepUntil = std::function<void(Timestamp)>;

inline void sleep_until_steady(Timestamp time) {
  std::this_thread::sleep_until(time);
}

// Sleeps until `due`, but not beyond `deadline`; says whether `due` has come.
inline bool wait_until(Timestamp due, Timestamp deadline, const Clock& clock, const SleepUntil& sleep) {
  const Timestamp wake = std::min(due, deadline);
  if (clock.now() < wake) sleep(wake);
  return clock.now() >= due;
}

// Lets a source that lost what it reads from look for it again, at most every 500 ms.
class RetryGate {
 public:
  static constexpr Duration interval = 500ms;

  void tried(Timestamp now) { next_ = now + interval; }
  void reset() { next_.reset(); }
  [[nodiscard]] Timestamp next(Timestamp now) const { return next_.value_or(now); }

 private:
  std::optional<Timestamp> next_;
};

}  // namespace telehug
