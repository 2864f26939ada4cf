// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <mutex>
#include <nlohmann/json.hpp>

namespace telehug {

// How many touches were felt since midnight, by local time, or since the start if that was later. Nothing else of them
// is kept. Any thread.
class TouchesToday {
 public:
  explicit TouchesToday(std::chrono::sys_seconds started) : since_(started) {}

  void add(std::chrono::sys_seconds now);
  // {"touches": 12, "since": "14:05"}; without since: since midnight.
  [[nodiscard]] nlohmann::json json(std::chrono::sys_seconds now) const;

 private:
  void begin_day(std::chrono::sys_seconds now) const;

  mutable std::mutex mutex_;
  mutable std::chrono::sys_seconds since_;  // guarded by mutex_, as what follows
  mutable bool whole_day_ = false;
  mutable std::uint64_t touches_ = 0;
};

}  // namespace telehug
