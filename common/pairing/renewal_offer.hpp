// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "pairing/pairing.hpp"

namespace telehug {

// So long before the first certificate of a pair ends it is renewed: time enough for two PCs that meet on holidays.
inline constexpr auto renewed_before_end = std::chrono::hours(24 * 60);

// The wearer's side of renewals that take place by themselves: makes one when it is time, and knows the newest one, for
// the parent's PC whenever that comes. It never learns whether it has arrived; one that has is nothing to do there.
class RenewalOffer {
 public:
  explicit RenewalOffer(const Pair& pair);

  // Call it now and then; it looks at the files every ten seconds. An error, once an hour: the pair could not be
  // renewed.
  [[nodiscard]] Status serve(WallTime now);

  // Made here, by hand (`telehug pair renew`) or by an earlier run.
  [[nodiscard]] const std::optional<Renewal>& newest() const noexcept { return newest_; }

 private:
  [[nodiscard]] Status look(WallTime now);

  PairStore store_;
  std::string id_;
  WallTime looked_at_;
  WallTime failed_at_;
  std::optional<Renewal> newest_;
};

}  // namespace telehug
