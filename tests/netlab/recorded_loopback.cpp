// SPDX-License-Identifier: Apache-2.0
#include "netlab/recorded_loopback.hpp"

#include <poll.h>

#include <stdexcept>

#include "doubles/child_program.hpp"

namespace telehug {

RecordedLoopback::RecordedLoopback() {
  const InsideNamespace inside(network_);
  if (ChildProgram({"ip", "link", "set", "lo", "up"}).wait_for_end() != 0)
    throw std::runtime_error("the loopback interface can't be turned on");
  port_.emplace(network_, "lo");
  recorder_ = std::jthread([this](const std::stop_token& stop) { record(stop); });
}

RecordedLoopback::~RecordedLoopback() = default;

std::vector<CapturedPacket> RecordedLoopback::packets() const {
  const std::lock_guard lock(mutex_);
  return packets_;
}

void RecordedLoopback::record(const std::stop_token& stop) {
  constexpr int longest_wait_ms = 20;  // so that the end is noticed soon
  while (!stop.stop_requested()) {
    pollfd waiting{port_->descriptor(), POLLIN, 0};
    if (poll(&waiting, 1, longest_wait_ms) <= 0) continue;
    for (Bytes frame = port_->receive(); !frame.empty(); frame = port_->receive()) {
      const std::lock_guard lock(mutex_);
      packets_.push_back({SteadyClock{}.now(), std::move(frame)});
    }
  }
}

}  // namespace telehug
