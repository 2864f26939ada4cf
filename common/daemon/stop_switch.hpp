// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "peer_link/peer_link.hpp"
#include "service/control_server.hpp"

namespace telehug {

// This side's own stop: set and lifted on the local socket, followed by the pipeline, told to the peer.
class StopSwitch {
 public:
  // Adds the commands "stop" and "resume" to `control`, which this must outlive.
  void serve(ControlServer& control);

  // Stops whatever the request says beside it: a reason that is no text is left out.
  nlohmann::json stop(const nlohmann::json& request);
  // Refused while it is held.
  nlohmann::json resume();

  // Stops, and lets nobody resume until release(), for what stands pressed or is broken. obstacle: a sentence that
  // tells who wants to resume why not, and what to do.
  void hold(std::string reason, std::string obstacle);
  // Still stopped.
  void release();

  // --- any thread; nobody waits here for the network ---

  [[nodiscard]] bool stopped() const noexcept { return stopped_; }
  // One line; empty if not stopped.
  [[nodiscard]] std::string reason() const;

  // --- housekeeping thread ---

  // Tells a peer of the last stop or resume until it has left. A resume is told even if nothing was stopped here: the
  // peer may still hold the stop of an earlier run of this program.
  void tell(PeerLink& peer) const;

 private:
  void set(bool stopped, std::string reason);  // with mutex_ held

  std::atomic<bool> stopped_ = false;
  mutable std::mutex mutex_;
  std::string reason_;                   // guarded by mutex_
  bool ever_set_ = false;                // likewise
  std::optional<std::string> obstacle_;  // likewise: while held
};

}  // namespace telehug
