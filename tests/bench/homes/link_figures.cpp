// SPDX-License-Identifier: Apache-2.0
#include "bench/homes/link_figures.hpp"

#include <algorithm>
#include <set>

#include "bench/homes/planned_touch.hpp"

namespace telehug {

std::vector<double> ages_ms(const std::vector<Arrival>& arrivals, const Span& span, int rate_hz, std::mt19937& random) {
  std::vector<double> ages;
  std::uniform_real_distribution<double> chance(0, 1);
  std::int64_t newest_sent_ns = 0;
  std::size_t next = 0;
  const Duration period = Duration(1s) / rate_hz;
  for (Timestamp slot = span.from; slot + period <= span.until; slot += period) {
    const std::int64_t look_ns = to_ns(slot + std::chrono::duration_cast<Duration>(period * chance(random)));
    for (; next < arrivals.size() && arrivals[next].arrived_ns <= look_ns; ++next)
      newest_sent_ns = std::max(newest_sent_ns, arrivals[next].sent_ns);
    if (newest_sent_ns > 0) ages.push_back(static_cast<double>(look_ns - newest_sent_ns) / 1e6);
  }
  return ages;
}

LinkFigures link_figures(const std::vector<Arrival>& arrivals, const Span& span, int rate_hz, std::mt19937& random) {
  LinkFigures figures;
  figures.age_ms = ages_ms(arrivals, span, rate_hz, random);
  std::set<std::uint64_t> states;
  std::set<std::uint64_t> transitions;
  for (const Arrival& arrival : arrivals) {
    if (arrival.of == Arrival::Of::transition) transitions.insert(arrival.sequence);
    const bool counts =
        arrival.of == Arrival::Of::state && arrival.sent_ns >= to_ns(span.from) && arrival.sent_ns < to_ns(span.until);
    if (!counts || !states.insert(arrival.sequence).second) continue;
    figures.one_way_ms.push_back(static_cast<double>(arrival.arrived_ns - arrival.sent_ns) / 1e6);
  }
  if (states.empty()) return figures;
  figures.states = *states.rbegin() - *states.begin() + 1;
  figures.states_lost = figures.states - states.size();
  for (std::uint64_t sequence = *states.begin(); sequence <= *states.rbegin(); ++sequence) {
    if (!planned_transition(sequence)) continue;
    ++figures.transitions;
    if (!transitions.contains(sequence)) ++figures.transitions_lost;
  }
  return figures;
}

void add(LinkFigures& sum, const LinkFigures& figures) {
  sum.age_ms.insert(sum.age_ms.end(), figures.age_ms.begin(), figures.age_ms.end());
  sum.one_way_ms.insert(sum.one_way_ms.end(), figures.one_way_ms.begin(), figures.one_way_ms.end());
  sum.states += figures.states;
  sum.states_lost += figures.states_lost;
  sum.transitions += figures.transitions;
  sum.transitions_lost += figures.transitions_lost;
}

double quantile(std::vector<double> values, double part) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(part * static_cast<double>(values.size() - 1))];
}

}  // namespace telehug
