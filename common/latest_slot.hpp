// SPDX-License-Identifier: Apache-2.0
//
// A hand-over of one value between threads in which the newest wins: nothing ever queues up behind a slow reader.
#pragma once

#include <condition_variable>
#include <mutex>
#include <optional>
#include <utility>

#include "common/clock.hpp"

namespace telehug {

template <typename T>
class LatestSlot {
 public:
  // Returns true when an unread value was replaced.
  bool put(T value) {
    bool replaced = false;
    {
      const std::lock_guard lock(mutex_);
      replaced = value_.has_value();
      value_ = std::move(value);
    }
    filled_.notify_one();
    return replaced;
  }

  std::optional<T> take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(value_, std::nullopt);
  }

  // Never waits: nothing is taken while the other thread is just putting.
  std::optional<T> try_take() {
    const std::unique_lock lock(mutex_, std::try_to_lock);
    return lock.owns_lock() ? std::exchange(value_, std::nullopt) : std::nullopt;
  }

  std::optional<T> wait_and_take(Timestamp deadline) {
    std::unique_lock lock(mutex_);
    filled_.wait_until(lock, deadline, [this] { return value_.has_value(); });
    return std::exchange(value_, std::nullopt);
  }

 private:
  std::mutex mutex_;
  std::condition_variable filled_;
  std::optional<T> value_;
};

}  // namespace telehug
