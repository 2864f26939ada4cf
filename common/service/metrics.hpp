// SPDX-License-Identifier: Apache-2.0
//
// Counts and latencies that any thread may write to at any time: no lock, no allocation.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "common/clock.hpp"

namespace telehug {

class Counter {
 public:
  void add(std::uint64_t n = 1) noexcept { count_.fetch_add(n, std::memory_order_relaxed); }
  // For a count that is kept elsewhere and only shown here.
  void set(std::uint64_t n) noexcept { count_.store(n, std::memory_order_relaxed); }
  [[nodiscard]] std::uint64_t value() const noexcept { return count_.load(std::memory_order_relaxed); }

 private:
  std::atomic<std::uint64_t> count_{0};
};

// Durations in buckets of constant relative width: every octave has 16, so a percentile is off by at most 1/32
// (half a bucket) of its value. From 1 ns to 18 minutes; longer ones count as the longest.
class LatencyHistogram {
 public:
  struct Summary {
    std::uint64_t count = 0;
    double p50_ms = 0;
    double p99_ms = 0;
    double max_ms = 0;  // exact
  };

  // How many records were not longer than each of some times, from 16 us to a second in steps of two. Exact: a step is
  // the last nanosecond of an octave.
  struct Cumulative {
    struct Step {
      std::uint64_t up_to_ns = 0;
      std::uint64_t count = 0;
    };
    static constexpr unsigned first_octave = 14;
    static constexpr unsigned last_octave = 30;
    std::array<Step, last_octave - first_octave + 1> steps{};
    std::uint64_t count = 0;  // of all records
    std::uint64_t sum_ns = 0;
  };

  void record(Duration duration) noexcept;

  // `share` 0..1: the duration that this share of all records does not exceed; 0 without records.
  [[nodiscard]] double percentile_ms(double share) const noexcept;
  // Writers may go on meanwhile: then the parts may differ by the few records that came in between.
  [[nodiscard]] Summary summary() const noexcept;
  [[nodiscard]] Cumulative cumulative() const noexcept;

  static constexpr double largest_relative_error = 1.0 / 32;

 private:
  static constexpr unsigned sub_bits = 4;  // 16 buckets an octave
  static constexpr unsigned octaves = 40;  // 2^40 ns
  static constexpr std::size_t bucket_count = (octaves - sub_bits + 1) << sub_bits;

  static std::size_t bucket_of(std::uint64_t ns) noexcept;
  static double middle_ns(std::size_t bucket) noexcept;

  std::array<std::atomic<std::uint64_t>, bucket_count> buckets_{};
  std::atomic<std::uint64_t> count_{0};
  std::atomic<std::uint64_t> sum_ns_{0};
  std::atomic<std::uint64_t> max_ns_{0};
};

// All counters and histograms of a daemon by name. Ask for them while constructing and keep the references, which live
// as long as the registry; asking again for a name gives the same one.
class MetricsRegistry {
 public:
  [[nodiscard]] Counter& counter(const std::string& name);
  [[nodiscard]] LatencyHistogram& latency(const std::string& stage);

  // {name: count}
  [[nodiscard]] nlohmann::json counters_json() const;
  // {stage: {"p50":, "p99":, "max":, "count":}} in ms, without stages that have no record yet
  [[nodiscard]] nlohmann::json latencies_json() const;
  // Every stage with its histogram, by name; these live as long as the registry.
  [[nodiscard]] std::map<std::string, const LatencyHistogram*> latencies() const;

 private:
  mutable std::mutex mutex_;  // guards the maps, not what they hold
  std::map<std::string, std::unique_ptr<Counter>> counters_;
  std::map<std::string, std::unique_ptr<LatencyHistogram>> latencies_;
};

}  // namespace telehug
