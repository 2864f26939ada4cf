// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <vector>

#include "common/clock.hpp"

namespace telehug {

// Keeps what a callback of another thread delivers, for a test to wait for.
template <typename T>
class Inbox {
 public:
  std::function<void(const T&)> callback() {
    return [this](const T& message) {
      {
        const std::lock_guard lock(mutex_);
        messages_.push_back(message);
      }
      arrived_.notify_all();
    };
  }

  // False if there are still fewer messages after `patience`.
  bool wait_for(std::size_t count, Duration patience = 10s) {
    return wait_until([&](const std::vector<T>& messages) { return messages.size() >= count; }, patience);
  }

  // False if what came until then is still not so.
  bool wait_until(const std::function<bool(const std::vector<T>&)>& is_so, Duration patience = 10s) {
    std::unique_lock lock(mutex_);
    return arrived_.wait_for(lock, patience, [&] { return is_so(messages_); });
  }

  std::vector<T> messages() const {
    const std::lock_guard lock(mutex_);
    return messages_;
  }

 private:
  mutable std::mutex mutex_;
  std::condition_variable arrived_;
  std::vector<T> messages_;
};

}  // namespace telehug
