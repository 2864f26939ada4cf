// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>
#include <vector>

#include "netlab/ethernet_port.hpp"
#include "netlab/net_namespace.hpp"

namespace telehug {

// A PC without any network but its loopback interface, on which everything is recorded.
class RecordedLoopback {
 public:
  // Throws std::system_error where namespaces are not permitted.
  RecordedLoopback();
  ~RecordedLoopback();
  RecordedLoopback(const RecordedLoopback&) = delete;
  RecordedLoopback& operator=(const RecordedLoopback&) = delete;

  [[nodiscard]] const NetNamespace& network() const noexcept { return network_; }
  // All until now.
  [[nodiscard]] std::vector<CapturedPacket> packets() const;

 private:
  void record(const std::stop_token& stop);

  NetNamespace network_;
  std::optional<EthernetPort> port_;
  mutable std::mutex mutex_;
  std::vector<CapturedPacket> packets_;
  std::jthread recorder_;
};

}  // namespace telehug
