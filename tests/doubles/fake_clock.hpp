// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/clock.hpp"

namespace telehug {

// A clock that stands still until a test moves it.
class FakeClock final : public Clock {
 public:
  [[nodiscard]] Timestamp now() const noexcept override { return now_; }
  void advance(Duration by) noexcept { now_ += by; }

 private:
  Timestamp now_ = from_ns(1'000'000'000);
};

}  // namespace telehug
