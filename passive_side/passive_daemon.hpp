// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <boost/lockfree/spsc_queue.hpp>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "common/latest_slot.hpp"
#include "common/version.hpp"
#include "config/config.hpp"
#include "daemon/link_keeper.hpp"
#include "daemon/membership.hpp"
#include "daemon/peer_absence.hpp"
#include "daemon/stop_switch.hpp"
#include "jacket/jacket_profile.hpp"
#include "passive_pipeline.hpp"
#include "peer_link/peer_link.hpp"
#include "peer_link/traffic.hpp"
#include "safety/safety_stage.hpp"
#include "service/control_server.hpp"
#include "service/exit_code.hpp"
#include "service/log.hpp"
#include "service/metrics.hpp"
#include "service/notifier.hpp"
#include "service/signals.hpp"

namespace telehug {

// What the drive thread tells of itself, for status.
struct DriveThreadState {
  LinkStatus link;
  SafetyCounters safety;
  PeerState peer;
  bool stopped = false;
  std::string stop_reason;
  std::vector<std::uint8_t> running;  // ids of actuators
  std::optional<Felt> last_felt;
  Gesture last_gesture = Gesture::none;
};

// Which actuators run, whenever that changes, for those who watch.
struct RunningChange {
  std::int64_t time_ns = 0;
  boost::container::static_vector<std::uint8_t, max_actuators> actuators;
};

// The child's PC: one thread from the touch event to the jacket, the calling one for everything that may take its time.
class PassiveDaemon {
 public:
  // Throws AlreadyRunning, std::runtime_error or std::invalid_argument with a sentence for a person.
  PassiveDaemon(const PassiveConfig& config, Membership membership, JacketProfile profile,
                std::unique_ptr<JacketLink> link, const Clock& clock);
  ~PassiveDaemon();
  PassiveDaemon(const PassiveDaemon&) = delete;
  PassiveDaemon& operator=(const PassiveDaemon&) = delete;

  // Until SIGTERM or SIGINT; the jacket is off when it returns.
  ExitCode run(Signals& signals);

 private:
  void end_thread();

  // Drive thread
  void drive_loop();
  void hear_peer(Timestamp now);
  void follow_stops(Timestamp now);
  void tell_running(Timestamp now);
  void tell_state(Timestamp now);

  // Housekeeping
  void tell_watchers();
  void tell_peer();
  void keep_link();
  void answer_commands();
  nlohmann::json status() const;
  [[nodiscard]] std::optional<SideStatus> peer_told() const;
  [[nodiscard]] PeerAbsence peer_absence() const;
  nlohmann::json problems(const DriveThreadState& state) const;
  [[nodiscard]] DriveThreadState state() const;

  PassiveConfig config_;
  const Membership membership_;
  const Clock& clock_;
  Timestamp started_;
  SessionId session_;
  MetricsRegistry metrics_;
  Notifier notifier_;
  const JacketProfile profile_;
  SafetyStage safety_;
  PassivePipeline pipeline_;

  // Drive thread
  Timestamp told_state_;
  DriveThreadState own_state_;
  boost::container::static_vector<std::uint8_t, max_actuators> told_running_;
  Counter& events_received_;
  Counter& events_replaced_;
  Counter& events_unvouched_;
  LatencyHistogram& total_latency_;

  // Between the threads
  struct Arrival {
    TouchEvent event;
    Timestamp time;
  };
  LatestSlot<Arrival> newest_event_;
  StopSwitch stop_;
  std::atomic<bool> ending_ = false;
  mutable std::mutex state_mutex_;
  DriveThreadState state_;
  boost::lockfree::spsc_queue<Felt, boost::lockfree::capacity<1024>> felt_;
  boost::lockfree::spsc_queue<RunningChange, boost::lockfree::capacity<1024>> running_;

  // Housekeeping
  mutable std::mutex words_mutex_;  // guards the next, which the control thread reads
  std::optional<SideStatus> peer_status_;
  SayOnChange say_jacket_;
  SayOnChange say_peer_;

  LinkKeeper link_keeper_;
  PeerLink peer_;
  Traffic<Felt, TouchEvent> traffic_;
  std::unique_ptr<ControlServer> control_;
  std::thread drive_thread_;
};

}  // namespace telehug
