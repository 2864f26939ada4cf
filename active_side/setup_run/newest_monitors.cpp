// SPDX-License-Identifier: Apache-2.0
#include "setup_run/newest_monitors.hpp"

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <thread>
#include <utility>

namespace telehug {

struct NewestMonitors::Shared {
  std::mutex mutex;
  std::condition_variable changed;
  std::vector<SizedMonitor> monitors;
  std::uint64_t wanted = 1;  // how many questions there were
  std::uint64_t asked = 0;   // up to which of them `monitors` answers
  bool ending = false;

  void serve(const std::function<std::vector<SizedMonitor>()>& ask) {
    std::unique_lock lock(mutex);
    while (true) {
      changed.wait(lock, [this] { return ending || wanted != asked; });
      if (ending) return;
      const std::uint64_t question = wanted;
      lock.unlock();
      auto answer = ask();
      lock.lock();
      monitors = std::move(answer);
      asked = question;
      changed.notify_all();
    }
  }
};

// Detached, since nobody could wait for its end while the X server hangs.
NewestMonitors::NewestMonitors(std::function<std::vector<SizedMonitor>()> ask) : shared_(std::make_shared<Shared>()) {
  std::thread([shared = shared_, ask = std::move(ask)] { shared->serve(ask); }).detach();
}

NewestMonitors::~NewestMonitors() {
  const std::lock_guard lock(shared_->mutex);
  shared_->ending = true;
  shared_->changed.notify_all();
}

std::vector<SizedMonitor> NewestMonitors::newest() {
  std::unique_lock lock(shared_->mutex);
  const std::uint64_t question = ++shared_->wanted;
  shared_->changed.notify_all();
  shared_->changed.wait_for(lock, longest_wait, [&] { return shared_->asked >= question; });
  return shared_->monitors;
}

}  // namespace telehug
