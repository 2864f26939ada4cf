// SPDX-License-Identifier: Apache-2.0
#include "passive_daemon.hpp"

#include <algorithm>

#include "daemon/daemon_settings.hpp"
#include "peer/session_id.hpp"

namespace telehug {
namespace {

constexpr Duration drive_round = 10ms;  // the safety stage wants to be served this often
constexpr Duration housekeeping_round = 20ms;
constexpr Duration state_interval = 100ms;
constexpr Duration oldest_heartbeat = 50ms;  // between its arrival and its being read

SafetyLimits safety_limits(const SafetyConfig& config) {
  SafetyLimits limits;
  limits.max_strength = config.max_strength;
  limits.heartbeat_timeout = std::chrono::milliseconds(config.heartbeat_timeout_ms);
  return limits;
}

}  // namespace

PassiveDaemon::PassiveDaemon(const PassiveConfig& config, Membership membership, JacketProfile profile,
                             std::unique_ptr<JacketLink> link, const Clock& clock)
    : config_(config),
      membership_(std::move(membership)),
      clock_(clock),
      started_(clock.now()),
      session_(new_session_id()),
      profile_(std::move(profile)),
      safety_(std::move(link), profile_, safety_limits(config.safety)),
      pipeline_(profile_, safety_, std::chrono::milliseconds(config.safety.drive_ms), session_, clock_, metrics_),
      events_received_(metrics_.counter("events_received")),
      events_replaced_(metrics_.counter("events_replaced_by_newer")),
      events_unvouched_(metrics_.counter("events_without_heartbeat")),
      total_latency_(metrics_.latency("event_to_link")),
      link_keeper_(membership_.dds, clock),
      peer_(link_keeper_.participant(), Side::passive, session_,
            std::chrono::milliseconds(config.safety.heartbeat_timeout_ms), clock),
      traffic_([this](const TouchEvent& event) {
        events_received_.add();
        const bool replaced = newest_event_.put({event, clock_.now()});
        if (replaced) events_replaced_.add();
      }),
      control_(std::make_unique<ControlServer>(control_options(config.control, Side::passive))) {
  answer_commands();
  traffic_.connect(link_keeper_.participant());
}

PassiveDaemon::~PassiveDaemon() {
  end_thread();
  traffic_.disconnect();
  peer_.disconnect();
}

ExitCode PassiveDaemon::run(Signals& signals) {
  control_->start();
  drive_thread_ = std::thread([this] { drive_loop(); });
  notifier_.ready();
  spdlog::info("telehug-passive {} runs; jacket: {} on {}; {}", version, profile_.name, config_.jacket.link,
               describe(membership_));
  for (const std::string& note : profile_.notes)
    spdlog::info("{}", note);
  std::optional<std::string> over;
  while (signals.wait(housekeeping_round) != SignalRequest::stop) {
    over = pair_over(membership_, wall_time());
    if (over) break;
    tell_watchers();
    tell_peer();
    keep_link();
  }
  notifier_.stopping();
  end_thread();
  if (over) spdlog::error("{}", *over);
  if (over) peer_.tell_pair_over(version);
  spdlog::info("telehug-passive ends; the jacket is off");
  return over ? ExitCode::pair_ended : ExitCode::ok;
}

void PassiveDaemon::end_thread() {
  ending_ = true;
  if (drive_thread_.joinable()) drive_thread_.join();
  // The queue's own destructor (Boost 1.74) does not destroy what it holds.
  felt_.consume_all([](const Felt&) {});
}

// --- drive thread ---

void PassiveDaemon::drive_loop() {
  while (!ending_) {
    const auto arrival = newest_event_.wait_and_take(clock_.now() + drive_round);
    // The safety stage takes a time that goes back for a fault: each call gets the present one.
    hear_peer(clock_.now());
    follow_stops(clock_.now());
    // Only the sender whose heartbeats are heard may touch: another's would vouch for it.
    const bool known_sender = arrival && arrival->event.session == peer_.peer_session();
    if (arrival && !known_sender) events_unvouched_.add();
    if (known_sender) {
      for (const Felt& felt : pipeline_.process(arrival->event, arrival->time)) {
        traffic_.write(felt);
        own_state_.last_felt = felt;
        felt_.push(felt);
      }
      own_state_.last_gesture = pipeline_.last_gesture();
      total_latency_.record(clock_.now() - arrival->time);
    }
    const Timestamp now = clock_.now();
    safety_.tick(now);
    tell_running(now);
    tell_state(now);
    notifier_.alive(now);
  }
  safety_.stop("telehug-passive ends", clock_.now());
}

void PassiveDaemon::hear_peer(Timestamp now) {
  const auto heard = peer_.serve(now);
  if (!heard) return;
  pipeline_.observe(heard->heartbeat, heard->time);
  // One that has waited here while this thread was held up vouches for nothing any more.
  if (now - heard->time < oldest_heartbeat) safety_.on_heartbeat(now);
}

void PassiveDaemon::follow_stops(Timestamp now) {
  const bool own = stop_.stopped();
  const bool stop = own || peer_.stopped_by_peer();
  if (stop == safety_.stopped()) return;
  if (!stop) {
    safety_.resume();
    return;
  }
  safety_.stop(own ? stop_.reason() : "the other side has stopped everything", now);
}

void PassiveDaemon::tell_running(Timestamp now) {
  const auto running = safety_.running();
  if (running == told_running_) return;
  told_running_ = running;
  running_.push({to_ns(now), running});
}

void PassiveDaemon::tell_state(Timestamp now) {
  if (now - told_state_ < state_interval) return;
  const std::unique_lock lock(state_mutex_, std::try_to_lock);
  if (!lock.owns_lock()) return;
  told_state_ = now;
  own_state_.link = safety_.link_status();
  own_state_.safety = safety_.counters();
  own_state_.peer = peer_.state(now);
  own_state_.stopped = safety_.stopped();
  own_state_.stop_reason = safety_.stop_reason();
  own_state_.running.assign(told_running_.begin(), told_running_.end());
  state_ = own_state_;
}

// --- housekeeping ---

DriveThreadState PassiveDaemon::state() const {
  const std::lock_guard lock(state_mutex_);
  return state_;
}

void PassiveDaemon::tell_peer() {
  stop_.tell(peer_);
  if (auto peer_status = peer_.take_peer_status()) {
    const std::lock_guard lock(words_mutex_);
    peer_status_ = *std::move(peer_status);
  }
  const DriveThreadState now = state();
  SideStatus own;
  own.session = session_;
  own.side = Side::passive;
  own.version = version;
  own.stopped = now.stopped;
  own.ready = now.link.state == LinkState::armed && !now.stopped;
  own.reason = stop_.stopped() ? stop_.reason()
               : now.stopped   ? now.stop_reason
               : own.ready     ? ""
                               : "no jacket answers: " + now.link.problem;
  peer_.tell(own);
}

void PassiveDaemon::keep_link() {
  link_keeper_.serve(state().peer, LinkKeeper::endpoints(peer_, traffic_));
}

}  // namespace telehug
