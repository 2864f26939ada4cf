// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "peer_link/peer_link.hpp"
#include "service/control_server.hpp"
#include "service/log.hpp"

namespace telehug {

// This side's own stop: set and lifted on the local socket, followed by the pipeline, told to the peer, kept in a file
// over restarts. It takes effect before it is kept, and whether it can be or not.
class StopSwitch {
 public:
  // As it was kept in `file`. If that can't be read everything is stopped, and a resume begins anew.
  explicit StopSwitch(std::filesystem::path file);

  // Adds the commands "stop" and "resume" to `control`, which this must outlive. Each is kept before it is answered.
  void serve(ControlServer& control);

  // --- any thread; nobody waits here for network or disk ---

  // Stops whatever the request says beside it: a reason that is no text is left out.
  nlohmann::json stop(const nlohmann::json& request);
  // Refused while it is held.
  nlohmann::json resume();

  // Stops, and lets nobody resume until release(), for what stands pressed or is broken. obstacle: a sentence that
  // tells who wants to resume why not, and what to do.
  void hold(const std::string& reason, std::string obstacle);
  // Still stopped.
  void release();

  [[nodiscard]] bool stopped() const noexcept { return stopped_; }
  // One line; empty if not stopped.
  [[nodiscard]] std::string reason() const;
  // Why it can't be read or kept, and what to do: {"what", "do"}; null if it can.
  [[nodiscard]] nlohmann::json problem() const;

  // --- housekeeping thread ---

  // Writes what has changed and was not kept yet; what can't be written is tried again now and then.
  void keep(Timestamp now);

  // Tells a peer of the last stop or resume until it has left. A resume is told even if nothing was stopped here: the
  // peer may still hold the stop of an earlier run of this program.
  void tell(PeerLink& peer) const;

 private:
  void set(bool stopped, std::string reason);  // with mutex_ held
  void write();

  const std::filesystem::path file_;
  std::atomic<bool> stopped_ = false;
  mutable std::mutex mutex_;
  std::string reason_;                   // guarded by mutex_
  std::optional<std::string> obstacle_;  // likewise: while held
  std::uint64_t changes_ = 0;            // likewise: stops and resumes so far
  std::uint64_t kept_ = 0;               // likewise: the last of them that is in the file
  std::uint64_t tried_ = 0;              // likewise: that was to be written
  nlohmann::json problem_;               // likewise
  std::optional<Timestamp> tried_at_;    // housekeeping's
  std::mutex writing_;                   // one after the other
  SayOnChange say_;                      // guarded by writing_
};

}  // namespace telehug
