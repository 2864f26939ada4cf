// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "common/latest_slot.hpp"
#include "local_touch/local_touch_outputs.hpp"

namespace telehug {

// Feeds the local outputs from a thread of its own, so that none of them can hold up or stop the touch path.
class LocalTouch {
 public:
  // Without outputs it does nothing and has no thread. `clock` outlives it.
  LocalTouch(std::vector<std::unique_ptr<LocalTouchOutput>> outputs, const Clock& clock);
  ~LocalTouch();
  LocalTouch(const LocalTouch&) = delete;
  LocalTouch& operator=(const LocalTouch&) = delete;

  [[nodiscard]] bool on() const noexcept { return on_; }

  // Touch thread: what touches now. Only hands over; the newest wins.
  void put(const ContactStates& contacts, const ScreenSize& screen, Timestamp time);

  // Any thread.
  [[nodiscard]] std::vector<LocalTouchState> states() const;

 private:
  void run();

  const Clock& clock_;
  const bool on_;
  LocalTouchOutputs outputs_;  // the thread's
  LatestSlot<LocalTouchFrame> newest_;
  std::atomic<bool> ending_ = false;
  mutable std::mutex mutex_;
  std::vector<LocalTouchState> states_;  // guarded by mutex_
  std::thread thread_;
};

}  // namespace telehug
