// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <mutex>
#include <optional>
#include <set>
#include <string>

#include "common/clock.hpp"
#include "dds/strangers.hpp"

namespace telehug {

// Who tried to connect and does not belong to the pair, beyond the participant that saw it: that is replaced every few
// seconds while the peer is away.
class StrangerNote {
 public:
  // Longer than a participant is kept while the peer is silent, so that a stranger who stays is told without a gap.
  static constexpr Duration remembered_for = 40s;

  // --- one thread ---

  // `refusals`: of the present participant, counted from 0. `own_addresses`: "interface address" each; what else runs
  // on this PC is no stranger to its user.
  void look(const std::optional<Stranger>& seen, std::uint64_t refusals, const std::set<std::string>& own_addresses,
            Timestamp now);
  void participant_replaced();

  // --- any thread ---

  [[nodiscard]] std::optional<Stranger> stranger() const;
  [[nodiscard]] std::uint64_t refusals() const;

 private:
  mutable std::mutex mutex_;
  std::optional<Stranger> stranger_;
  Timestamp seen_at_;
  std::uint64_t refusals_before_ = 0;  // by participants that are gone
  std::uint64_t refusals_ = 0;         // by the present one
};

}  // namespace telehug
