// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <boost/lockfree/spsc_queue.hpp>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "common/latest_slot.hpp"
#include "common/version.hpp"
#include "config/config.hpp"
#include "connected_sender.hpp"
#include "consent_switch.hpp"
#include "daemon/config_reload.hpp"
#include "daemon/connections.hpp"
#include "daemon/pairing_desk.hpp"
#include "daemon/stop_switch.hpp"
#include "gpio/panel.hpp"
#include "hug_back.hpp"
#include "jacket/jacket_profile.hpp"
#include "jacket_trial.hpp"
#include "limit_notes.hpp"
#include "passive_pipeline.hpp"
#include "safety/safety_stage.hpp"
#include "service/control_server.hpp"
#include "service/exit_code.hpp"
#include "service/log.hpp"
#include "service/metrics.hpp"
#include "service/notifier.hpp"
#include "service/signals.hpp"
#include "touches_today.hpp"
#include "web/daemon_pages.hpp"

namespace telehug {

// What became of the wearer's last trial.
struct TrialOutcome {
  std::uint64_t number = 0;
  FeltOutcome outcome = FeltOutcome::driven;
};

// What the drive thread tells of itself, for status.
struct DriveThreadState {
  LinkStatus link;
  SafetyCounters safety;
  HeaterReports heaters;
  DutyReports duties;
  bool stopped = false;
  std::string stop_reason;
  std::vector<std::uint8_t> running;  // ids of actuators
  std::optional<Felt> last_felt;
  Gesture last_gesture = Gesture::none;
  std::optional<TrialOutcome> trial;
};

// Which actuators run, whenever that changes, for those who watch.
struct RunningChange {
  std::int64_t time_ns = 0;
  boost::container::static_vector<std::uint8_t, max_actuators> actuators;
};

// An answer, and to whom it was given.
struct GivenAnswer {
  Felt felt;
  SenderNumber sender = 0;
};

// A line of the configuration that the jacket is not driven without can't be had.
class LineMissing : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// The child's PC: one thread from the touch events to the jacket, the calling one for everything that may take its
// time. Everyone whom the wearer has granted a pair may touch, each through a connection of their own.
class PassiveDaemon {
 public:
  // Throws AlreadyRunning, LineMissing, std::runtime_error or std::invalid_argument with a sentence for a person.
  PassiveDaemon(const PassiveConfig& config, Memberships memberships, JacketProfile profile,
                std::unique_ptr<JacketLink> link, const Clock& clock);
  ~PassiveDaemon();
  PassiveDaemon(const PassiveDaemon&) = delete;
  PassiveDaemon& operator=(const PassiveDaemon&) = delete;

  // Until SIGTERM or SIGINT; the jacket is off when it returns. SIGHUP reads the configuration anew.
  ExitCode run(Signals& signals, const ConfigReload<PassiveConfig>& configuration);

 private:
  using Senders = Connections<ConnectedSender>;

  [[nodiscard]] std::shared_ptr<ConnectedSender> connect(Membership membership, const Senders::List& others);
  void end_thread();

  // Drive thread
  void drive_loop();
  void adopt_senders();
  void hear(ConnectedSender& sender, Timestamp now);
  void process_newest_event(ConnectedSender& sender);
  void follow_stops(Timestamp now);
  void follow_consent();
  void follow_trial(Timestamp now);
  void tell_running(Timestamp now);
  void tell_state(Timestamp now);
  void tell_panel(Timestamp now);

  // Housekeeping
  void reload(const ConfigReload<PassiveConfig>& configuration);
  [[nodiscard]] bool follow_pairs();
  void tell_watchers();
  void tell_running_to_all();
  void tell_pages();
  void tell_of_limits();
  void keep_connections();
  void answer_commands();
  void answer_hug_button();
  nlohmann::json order_hug(const nlohmann::json& request);
  nlohmann::json order_trial(const nlohmann::json& request);
  nlohmann::json describe_jacket(const nlohmann::json& request) const;
  nlohmann::json status() const;
  [[nodiscard]] std::string actuator_name(std::uint8_t id) const;
  void add_safety_problems(nlohmann::json& list, const DriveThreadState& state) const;
  void add_safety_status(nlohmann::json& answer, const DriveThreadState& state) const;
  static void add_safety_counters(nlohmann::json& counters, const SafetyCounters& safety);
  void add_panel(nlohmann::json& status) const;
  [[nodiscard]] std::vector<ConnectionStatus> connections() const;
  nlohmann::json problems(const DriveThreadState& state, const std::vector<ConnectionStatus>& connections) const;
  [[nodiscard]] DriveThreadState state() const;
  [[nodiscard]] std::unique_ptr<Panel> make_panel();

  PassiveConfig config_;  // of it [consent] quiet_hours and [log] change, which the housekeeping thread alone looks at
  const std::vector<std::string> left_out_;  // pairs that could not be used at the start, and why
  const Clock& clock_;
  Timestamp started_;
  SessionId session_;
  MetricsRegistry metrics_;
  Notifier notifier_;
  const JacketProfile profile_;
  SafetyStage safety_;
  SenderTurn turn_;

  // Drive thread
  Timestamp told_state_;
  DriveThreadState own_state_;
  JacketTrial trial_;
  Consent wanted_;
  WallTime wall_;                           // of the last look at the clock
  int local_minute_now_ = 0;                // then
  std::array<bool, max_senders> driven_{};  // the numbers of those that are connected
  boost::container::static_vector<std::uint8_t, max_actuators> told_running_;
  Counter& events_received_;
  Counter& events_replaced_;
  Counter& events_unvouched_;
  LatencyHistogram& total_latency_;

  // Between the threads
  LatestSlot<bool> bell_;  // rung after every event that came
  struct OrderedTrial {
    std::uint64_t number;
    TrialRequest request;
  };
  LatestSlot<OrderedTrial> trial_request_;
  StopSwitch stop_;
  ConsentSwitch consent_;
  std::atomic<bool> hug_pressed_ = false;  // on the jacket's button, and not answered yet
  std::atomic<bool> ending_ = false;
  mutable std::mutex state_mutex_;
  DriveThreadState state_;
  boost::lockfree::spsc_queue<GivenAnswer, boost::lockfree::capacity<1024>> felt_;
  boost::lockfree::spsc_queue<RunningChange, boost::lockfree::capacity<1024>> running_;

  // Housekeeping
  ReloadNotes reload_notes_{Side::passive};
  SayOnChange say_jacket_;
  SayOnChange say_consent_;
  LimitNotes limit_notes_;
  Timestamp told_pages_;
  std::set<std::uint8_t> runs_;          // as last heard of the drive thread
  std::set<std::uint8_t> running_told_;  // to the pages

  TouchesToday touches_today_;
  std::uint64_t trials_ordered_ = 0;  // the control thread's
  std::mutex hug_mutex_;
  HugBack hug_back_;  // guarded by it
  Counter& hugs_sent_;
  Counter& hugs_too_soon_;

  Senders senders_;
  std::unique_ptr<Panel> panel_;
  std::optional<PairingDesk> pairing_;  // ends after what asks it
  std::unique_ptr<ControlServer> control_;
  DaemonPages pages_;
  std::thread drive_thread_;
};

}  // namespace telehug
