// SPDX-License-Identifier: Apache-2.0
#include "service/metrics.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>

namespace telehug {

// Below 2^sub_bits every value has a bucket of its own; above, a value is its octave and the bits after its leading
// one.
std::size_t LatencyHistogram::bucket_of(std::uint64_t ns) noexcept {
  ns = std::min(ns, (std::uint64_t{1} << octaves) - 1);
  if (ns < (std::uint64_t{1} << sub_bits)) return static_cast<std::size_t>(ns);
  const unsigned shift = static_cast<unsigned>(std::bit_width(ns)) - 1 - sub_bits;
  return (static_cast<std::size_t>(shift + 1) << sub_bits) + (static_cast<std::size_t>(ns >> shift) & 0xF);
}

double LatencyHistogram::middle_ns(std::size_t bucket) noexcept {
  constexpr std::size_t per_octave = std::size_t{1} << sub_bits;
  if (bucket < per_octave) return static_cast<double>(bucket);
  const std::size_t shift = (bucket >> sub_bits) - 1;
  const double width = std::ldexp(1.0, static_cast<int>(shift));
  // A bucket holds the whole numbers from its start to one before the next bucket's.
  return static_cast<double>(per_octave + (bucket & (per_octave - 1))) * width + (width - 1) / 2;
}

void LatencyHistogram::record(Duration duration) noexcept {
  const auto signed_ns = std::chrono::duration_cast<std::chrono::nanoseconds>(duration).count();
  const auto ns = static_cast<std::uint64_t>(std::max<std::int64_t>(signed_ns, 0));
  buckets_[bucket_of(ns)].fetch_add(1, std::memory_order_relaxed);
  count_.fetch_add(1, std::memory_order_relaxed);
  sum_ns_.fetch_add(ns, std::memory_order_relaxed);
  std::uint64_t longest = max_ns_.load(std::memory_order_relaxed);
  while (ns > longest && !max_ns_.compare_exchange_weak(longest, ns, std::memory_order_relaxed)) {
  }
}

double LatencyHistogram::percentile_ms(double share) const noexcept {
  std::uint64_t total = 0;
  for (const auto& bucket : buckets_)
    total += bucket.load(std::memory_order_relaxed);
  if (total == 0) return 0;
  // Nearest rank.
  const double rank = std::ceil(std::clamp(share, 0.0, 1.0) * static_cast<double>(total));
  const auto wanted = std::max<std::uint64_t>(1, static_cast<std::uint64_t>(rank));
  std::uint64_t seen = 0;
  for (std::size_t i = 0; i < buckets_.size(); ++i) {
    seen += buckets_[i].load(std::memory_order_relaxed);
    if (seen >= wanted) return middle_ns(i) * 1e-6;
  }
  return static_cast<double>(max_ns_.load(std::memory_order_relaxed)) * 1e-6;
}

LatencyHistogram::Summary LatencyHistogram::summary() const noexcept {
  const double max_ms = static_cast<double>(max_ns_.load(std::memory_order_relaxed)) * 1e-6;
  // A bucket's middle may lie above the only record in it.
  return {count_.load(std::memory_order_relaxed), std::min(percentile_ms(0.5), max_ms),
          std::min(percentile_ms(0.99), max_ms), max_ms};
}

LatencyHistogram::Cumulative LatencyHistogram::cumulative() const noexcept {
  Cumulative result;
  std::size_t bucket = 0;
  for (unsigned i = 0; i < result.steps.size(); ++i) {
    const std::uint64_t end_ns = std::uint64_t{1} << (Cumulative::first_octave + i);
    for (; bucket < bucket_of(end_ns); ++bucket)
      result.count += buckets_[bucket].load(std::memory_order_relaxed);
    result.steps[i] = {end_ns - 1, result.count};
  }
  for (; bucket < buckets_.size(); ++bucket)
    result.count += buckets_[bucket].load(std::memory_order_relaxed);
  result.sum_ns = sum_ns_.load(std::memory_order_relaxed);
  return result;
}

Counter& MetricsRegistry::counter(const std::string& name) {
  const std::lock_guard lock(mutex_);
  auto& entry = counters_[name];
  if (!entry) entry = std::make_unique<Counter>();
  return *entry;
}

LatencyHistogram& MetricsRegistry::latency(const std::string& stage) {
  const std::lock_guard lock(mutex_);
  auto& entry = latencies_[stage];
  if (!entry) entry = std::make_unique<LatencyHistogram>();
  return *entry;
}

nlohmann::json MetricsRegistry::counters_json() const {
  const std::lock_guard lock(mutex_);
  auto json = nlohmann::json::object();
  for (const auto& [name, counter] : counters_)
    json[name] = counter->value();
  return json;
}

std::map<std::string, const LatencyHistogram*> MetricsRegistry::latencies() const {
  const std::lock_guard lock(mutex_);
  std::map<std::string, const LatencyHistogram*> all;
  for (const auto& [stage, histogram] : latencies_)
    all[stage] = histogram.get();
  return all;
}

nlohmann::json MetricsRegistry::latencies_json() const {
  const std::lock_guard lock(mutex_);
  auto json = nlohmann::json::object();
  for (const auto& [stage, histogram] : latencies_) {
    const auto summary = histogram->summary();
    if (summary.count == 0) continue;
    json[stage] = {{"p50", summary.p50_ms}, {"p99", summary.p99_ms}, {"max", summary.max_ms}, {"count", summary.count}};
  }
  return json;
}

}  // namespace telehug
