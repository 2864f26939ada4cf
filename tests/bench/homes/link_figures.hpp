// SPDX-License-Identifier: Apache-2.0
//
// What a receiver's log says about a way. Pure.
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "bench/homes/arrival_log.hpp"
#include "common/clock.hpp"

namespace telehug {

struct Span {
  Timestamp from;
  Timestamp until;
};

struct LinkFigures {
  std::vector<double> age_ms;      // how old the newest state known is
  std::vector<double> one_way_ms;  // of each state that arrived
  std::uint64_t states = 0;        // sent
  std::uint64_t states_lost = 0;
  std::uint64_t transitions = 0;  // downs and ups that happened
  std::uint64_t transitions_lost = 0;
};

// The receiver's newest state is looked at `rate_hz` times a second, once in each period at a moment that chance
// chooses: both sides have one clock here, and a fixed moment would measure how the two loops happen to lie to each
// other.
[[nodiscard]] std::vector<double> ages_ms(const std::vector<Arrival>& arrivals, const Span& span, int rate_hz,
                                          std::mt19937& random);

// Everything about what was sent in the span. Receivers must have listened some time longer.
[[nodiscard]] LinkFigures link_figures(const std::vector<Arrival>& arrivals, const Span& span, int rate_hz,
                                       std::mt19937& random);

void add(LinkFigures& sum, const LinkFigures& figures);

// part: 0..1. Zero if there are no values.
[[nodiscard]] double quantile(std::vector<double> values, double part);

}  // namespace telehug
