// SPDX-License-Identifier: Apache-2.0
#include "service/metrics.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <random>
#include <thread>
#include <vector>

namespace telehug {
namespace {

// Nearest rank.
double exact_percentile_ms(std::vector<std::int64_t> sorted_ns, double share) {
  const auto rank = std::max(1.0, std::ceil(share * static_cast<double>(sorted_ns.size())));
  return static_cast<double>(sorted_ns[static_cast<std::size_t>(rank) - 1]) * 1e-6;
}

TEST(LatencyHistogram, AgreesWithSortedDataWithinItsStatedError) {
  std::mt19937 random(1);
  std::lognormal_distribution<double> spread(14, 2);  // around 1 ms, over four decades
  LatencyHistogram histogram;
  std::vector<std::int64_t> all_ns;
  for (int i = 0; i < 20'000; ++i) {
    const auto ns = static_cast<std::int64_t>(spread(random));
    all_ns.push_back(ns);
    histogram.record(std::chrono::nanoseconds(ns));
  }
  std::sort(all_ns.begin(), all_ns.end());
  for (const double share : {0.0, 0.01, 0.25, 0.5, 0.9, 0.99, 0.999, 1.0}) {
    const double exact = exact_percentile_ms(all_ns, share);
    EXPECT_NEAR(histogram.percentile_ms(share), exact, exact * LatencyHistogram::largest_relative_error) << share;
  }
  EXPECT_EQ(histogram.summary().max_ms, static_cast<double>(all_ns.back()) * 1e-6);
  EXPECT_EQ(histogram.summary().count, 20'000U);
}

TEST(LatencyHistogram, KeepsToItsErrorAtEveryMagnitude) {
  for (std::int64_t ns = 1; ns < (std::int64_t{1} << 40); ns = ns * 17 / 16 + 1) {
    LatencyHistogram histogram;
    histogram.record(std::chrono::nanoseconds(ns));
    const double exact = static_cast<double>(ns) * 1e-6;
    ASSERT_NEAR(histogram.percentile_ms(0.5), exact, exact * LatencyHistogram::largest_relative_error) << ns;
  }
}

TEST(LatencyHistogram, TakesWhatIsNegativeOrEndless) {
  LatencyHistogram histogram;
  histogram.record(-5ms);
  EXPECT_EQ(histogram.summary().max_ms, 0);
  histogram.record(std::chrono::hours(100));
  EXPECT_EQ(histogram.summary().max_ms, 3.6e8);
  EXPECT_EQ(histogram.summary().count, 2U);
}

TEST(LatencyHistogram, NeverReportsAPercentileAboveTheLongest) {
  LatencyHistogram histogram;
  histogram.record(1024us);
  const auto summary = histogram.summary();
  EXPECT_LE(summary.p99_ms, summary.max_ms);
  EXPECT_EQ(LatencyHistogram().summary().p99_ms, 0);
}

TEST(LatencyHistogram, LosesNothingWhenThreadsWriteAtOnce) {
  LatencyHistogram histogram;
  std::vector<std::thread> threads;
  for (int t = 1; t <= 4; ++t) {
    threads.emplace_back([&histogram, t] {
      for (int i = 0; i < 10'000; ++i)
        histogram.record(std::chrono::microseconds(t));
    });
  }
  for (auto& thread : threads)
    thread.join();
  EXPECT_EQ(histogram.summary().count, 40'000U);
  EXPECT_DOUBLE_EQ(histogram.summary().max_ms, 0.004);
}

TEST(MetricsRegistry, GivesTheSameCounterForTheSameName) {
  MetricsRegistry metrics;
  Counter& counter = metrics.counter("touches");
  counter.add();
  metrics.counter("touches").add(2);
  for (int i = 0; i < 100; ++i)
    (void)metrics.counter("other " + std::to_string(i));
  EXPECT_EQ(counter.value(), 3U);
  EXPECT_EQ(&counter, &metrics.counter("touches"));
}

TEST(MetricsRegistry, BecomesJson) {
  MetricsRegistry metrics;
  metrics.counter("touches").add(7);
  (void)metrics.latency("never used");
  for (int i = 0; i < 100; ++i)
    metrics.latency("finger").record(2ms);
  EXPECT_EQ(metrics.counters_json(), nlohmann::json({{"touches", 7}}));
  const auto stages = metrics.latencies_json();
  ASSERT_EQ(stages.size(), 1U);
  EXPECT_EQ(stages["finger"]["count"], 100);
  EXPECT_DOUBLE_EQ(stages["finger"]["max"].get<double>(), 2.0);
  EXPECT_NEAR(stages["finger"]["p50"].get<double>(), 2.0, 2.0 / 32);
}

}  // namespace
}  // namespace telehug
