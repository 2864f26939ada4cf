// SPDX-License-Identifier: Apache-2.0
#include "integration/link_faults/fault_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace telehug {
namespace {

constexpr Duration shortest_pause = 50ms;

std::string figure(std::optional<double> value, int digits) {
  return value ? fmt::format("{:.{}f}", *value, digits) : "-";
}

}  // namespace

FeltTimes::FeltTimes(const std::vector<PinChange>& pins) {
  std::set<int> running;
  for (const PinChange& change : pins) {
    const bool ran = !running.empty();
    change.on ? (void)running.insert(change.channel) : (void)running.erase(change.channel);
    if (!ran && !running.empty()) spans_.push_back({from_ns(change.time_ns), Timestamp::max()});
    if (ran && running.empty()) spans_.back().to = from_ns(change.time_ns);
  }
}

std::optional<Timestamp> FeltTimes::silent_since(Timestamp time) const {
  std::optional<Timestamp> since;
  for (const Span& span : spans_) {
    if (span.from > time) break;
    if (span.to > time) return std::nullopt;
    since = span.to;
  }
  return since;
}

std::optional<Timestamp> FeltTimes::felt_from(Timestamp time) const {
  for (const Span& span : spans_)
    if (span.to > time) return std::max(span.from, time);
  return std::nullopt;
}

std::optional<FeltTimes::Pause> FeltTimes::pause(Timestamp from, Timestamp to) const {
  std::optional<Pause> pause;
  Timestamp silent = from;
  for (const Span& span : spans_) {
    if (span.to < from || span.from > to) continue;
    if (span.from - silent >= shortest_pause) pause = {pause ? pause->from : silent, span.from};
    silent = span.to;
  }
  return pause;
}

double FeltTimes::share(Timestamp from, Timestamp to) const {
  Duration felt{};
  for (const Span& span : spans_)
    felt += std::max<Duration>(std::min(span.to, to) - std::max(span.from, from), 0ms);
  return to_ms(felt) / to_ms(to - from);
}

Duration FeltTimes::longest_gap(Timestamp from, Timestamp to) const {
  Duration longest{};
  Timestamp silent = from;
  for (const Span& span : spans_) {
    if (span.to < from || span.from > to) continue;
    longest = std::max(longest, span.from - silent);
    silent = span.to;
  }
  return std::max(longest, to - silent);
}

std::string table_text(const std::vector<FaultRow>& rows) {
  std::string text = fmt::format("{:<52} {:>12} {:>8} {:>15} {:>13}\n", "fault", "off after ms", "felt %",
                                 "longest gap ms", "back after s");
  for (const FaultRow& row : rows) {
    text += fmt::format("{:<52} {:>12} {:>8} {:>15} {:>13}\n", row.fault, figure(row.off_after_ms, 0),
                        figure(row.felt_percent, 1), figure(row.longest_gap_ms, 0), figure(row.back_after_s, 2));
  }
  return text;
}

}  // namespace telehug
