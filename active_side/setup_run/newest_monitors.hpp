// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "common/clock.hpp"
#include "screen_x11/x11_monitor_sizes.hpp"

namespace telehug {

// The monitors, asked for on a thread of its own: an X server that hangs holds up nobody else, and above all no stop.
class NewestMonitors {
 public:
  static constexpr Duration longest_wait = 250ms;

  // `ask` may outlive this while it hangs: what it refers to must live as long as the program. It is called at once,
  // then for each newest().
  explicit NewestMonitors(std::function<std::vector<SizedMonitor>()> ask);
  ~NewestMonitors();
  NewestMonitors(const NewestMonitors&) = delete;
  NewestMonitors& operator=(const NewestMonitors&) = delete;

  // As they are now; as they were when last heard of, or none, if that takes longer than `longest_wait`.
  [[nodiscard]] std::vector<SizedMonitor> newest();

 private:
  struct Shared;
  std::shared_ptr<Shared> shared_;
};

}  // namespace telehug
