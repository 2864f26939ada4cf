// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/clock.hpp"
#include "demo_record.hpp"

namespace telehug {

// When any motor ran at all.
class FeltTimes {
 public:
  explicit FeltTimes(const std::vector<PinChange>& pins);

  // Since when nothing runs at that time; nothing if a motor runs, or none ever did.
  [[nodiscard]] std::optional<Timestamp> silent_since(Timestamp time) const;
  // From then on, the first moment in which a motor runs.
  [[nodiscard]] std::optional<Timestamp> felt_from(Timestamp time) const;
  // The first pause between the two that is longer than a moment: its beginning, and the end of the last one.
  struct Pause {
    Timestamp from;
    Timestamp to;
  };
  [[nodiscard]] std::optional<Pause> pause(Timestamp from, Timestamp to) const;
  // Of the time between, how much a motor ran.
  [[nodiscard]] double share(Timestamp from, Timestamp to) const;
  [[nodiscard]] Duration longest_gap(Timestamp from, Timestamp to) const;

 private:
  struct Span {
    Timestamp from;
    Timestamp to;
  };
  std::vector<Span> spans_;
};

struct FaultRow {
  std::string fault;
  std::optional<double> off_after_ms = {};    // NOLINT(readability-redundant-member-init)
  std::optional<double> felt_percent = {};    // NOLINT(readability-redundant-member-init)
  std::optional<double> longest_gap_ms = {};  // NOLINT(readability-redundant-member-init)
  std::optional<double> back_after_s = {};    // NOLINT(readability-redundant-member-init)
};

[[nodiscard]] std::string table_text(const std::vector<FaultRow>& rows);

}  // namespace telehug
