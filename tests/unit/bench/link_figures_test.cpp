// SPDX-License-Identifier: Apache-2.0
//
// What the benchmark makes of a receiver's log must itself be right.
#include "bench/homes/link_figures.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "bench/homes/planned_touch.hpp"

namespace telehug {
namespace {

constexpr Timestamp start = from_ns(1'000'000'000);
constexpr int rate_hz = 100;

// States that are sent every 10 ms from `start` on and take 30 ms; those in `lost` never arrive.
std::vector<Arrival> arrivals_without(const std::vector<std::uint64_t>& lost, std::uint64_t count = 200) {
  std::vector<Arrival> arrivals;
  for (std::uint64_t sequence = 1; sequence <= count; ++sequence) {
    if (std::find(lost.begin(), lost.end(), sequence) != lost.end()) continue;
    const Timestamp sent = start + 10ms * (sequence - 1);
    arrivals.push_back({Arrival::Of::state, to_ns(sent + 30ms), sequence, to_ns(sent)});
  }
  return arrivals;
}

class LinkFiguresTest : public testing::Test {
 protected:
  std::mt19937 random{1};
  Span second{start + 500ms, start + 1500ms};
};

TEST_F(LinkFiguresTest, AgesLieBetweenTheDelayAndThatAndAPeriod) {
  const std::vector<double> ages = ages_ms(arrivals_without({}), second, rate_hz, random);
  ASSERT_EQ(ages.size(), 100U);
  EXPECT_GE(quantile(ages, 0), 30);
  EXPECT_LE(quantile(ages, 1), 40);
  EXPECT_NEAR(quantile(ages, 0.5), 35, 2);
}

TEST_F(LinkFiguresTest, ALostStateLeavesAnOlderOneTheNewest) {
  const LinkFigures figures = link_figures(arrivals_without({100, 101}), second, rate_hz, random);
  EXPECT_GT(quantile(figures.age_ms, 1), 50);
  EXPECT_LE(quantile(figures.age_ms, 1), 60);
  EXPECT_EQ(figures.states, 100U);
  EXPECT_EQ(figures.states_lost, 2U);
}

TEST_F(LinkFiguresTest, AStateThatWasOvertakenMakesNothingOlder) {
  std::vector<Arrival> arrivals = arrivals_without({100});
  const Timestamp sent = start + 990ms;
  const auto later = std::find_if(arrivals.begin(), arrivals.end(),
                                  [&](const Arrival& arrival) { return arrival.arrived_ns > to_ns(sent + 60ms); });
  arrivals.insert(later, {Arrival::Of::state, to_ns(sent + 60ms), 100, to_ns(sent)});
  const LinkFigures figures = link_figures(arrivals, second, rate_hz, random);
  EXPECT_LE(quantile(figures.age_ms, 1), 50);
  EXPECT_EQ(figures.states_lost, 0U);
  EXPECT_DOUBLE_EQ(quantile(figures.one_way_ms, 1), 60);
}

TEST_F(LinkFiguresTest, NothingIsKnownBeforeTheFirstArrival) {
  EXPECT_TRUE(ages_ms(arrivals_without({}), {start - 100ms, start + 30ms}, rate_hz, random).empty());
}

TEST_F(LinkFiguresTest, DownsAndUpsThatNoEventToldAreLost) {
  std::vector<Arrival> arrivals = arrivals_without({});
  std::uint64_t planned = 0;
  for (std::uint64_t sequence = 51; sequence <= 150; ++sequence) {
    if (!planned_transition(sequence)) continue;
    if (++planned > 1) arrivals.push_back({Arrival::Of::transition, to_ns(start + 1s), sequence, 0});
  }
  const LinkFigures figures = link_figures(arrivals, second, rate_hz, random);
  EXPECT_EQ(figures.transitions, planned);
  EXPECT_EQ(figures.transitions_lost, 1U);
}

TEST_F(LinkFiguresTest, EachPlannedDownAndUpIsToldWhereItIsCounted) {
  TouchEventBuilder builder("0123456789abcdef0123456789abcdef");
  for (std::uint64_t sequence = 1; sequence <= 3 * tap_frames; ++sequence) {
    const Timestamp now = start + 10ms * sequence;
    const TouchEvent* event = builder.build(planned_touch(sequence), 1, now, now);
    ASSERT_NE(event, nullptr);
    ASSERT_EQ(event->sequence, sequence);
    const bool told = std::any_of(event->transitions.begin(), event->transitions.end(),
                                  [&](const Transition& told_now) { return told_now.event_sequence == sequence; });
    EXPECT_EQ(told, planned_transition(sequence)) << sequence;
  }
}

}  // namespace
}  // namespace telehug
