// SPDX-License-Identifier: Apache-2.0
#include "passive_daemon.hpp"

#include <algorithm>
#include <ctime>
#include <stdexcept>

#include "config/places.hpp"
#include "config/quiet_hours_text.hpp"
#include "daemon/daemon_settings.hpp"
#include "passive_pages.hpp"
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
  limits.max_celsius = config.max_celsius;
  limits.heartbeat_timeout = std::chrono::milliseconds(config.heartbeat_timeout_ms);
  return limits;
}

}  // namespace

PassiveDaemon::PassiveDaemon(const PassiveConfig& config, Memberships memberships, JacketProfile profile,
                             std::unique_ptr<JacketLink> link, const Clock& clock)
    : config_(config),
      left_out_(std::move(memberships.left_out)),
      clock_(clock),
      started_(clock.now()),
      session_(new_session_id()),
      profile_(std::move(profile)),
      safety_(std::move(link), profile_, safety_limits(config.safety)),
      turn_(config.jacket.several_senders == "exclusive"),
      events_received_(metrics_.counter("events_received")),
      events_replaced_(metrics_.counter("events_replaced_by_newer")),
      events_unvouched_(metrics_.counter("events_without_heartbeat")),
      total_latency_(metrics_.latency("event_to_link")),
      stop_(stop_file(config.control, Side::passive)),
      consent_(consent_file(config.consent), parse_quiet_hours(config.consent.quiet_hours).value(), profile_),
      touches_today_(wall_time()),
      hug_back_(session_),
      hugs_sent_(metrics_.counter("hugs_sent")),
      hugs_too_soon_(metrics_.counter("hugs_too_soon")),
      senders_(PairsWatch(config.peer, Side::passive, clock),
               [this](Membership membership, const Senders::List& others) {
                 return connect(std::move(membership), others);
               }),
      control_(std::make_unique<ControlServer>(control_options(config.control, Side::passive))),
      pages_(config.web, passive_pages_options(), *control_, clock) {
  pairing_.emplace(Side::passive, pairs_folder(config.peer, Side::passive),
                   config.peer.loopback_only ? "127.0.0.1" : "", *control_);
  wanted_ = consent_.consent();
  panel_ = make_panel();  // not before it is known that no other daemon has its lines
  answer_commands();
  senders_.open(std::move(memberships.members));
}

PassiveDaemon::~PassiveDaemon() {
  end_thread();
  control_.reset();  // its handlers use the pages
}

std::shared_ptr<ConnectedSender> PassiveDaemon::connect(Membership membership, const Senders::List& others) {
  std::vector<SenderNumber> taken;
  for (const auto& other : others)
    taken.push_back(other->number);
  const auto number = free_sender_number(taken);
  // Where pairs come while others go: the numbers of these are free as soon as the drive thread has let go of them.
  if (!number) throw std::runtime_error("those that have just ended still take up all places");
  PassivePipeline pipeline(*number, profile_, safety_, turn_, std::chrono::milliseconds(config_.safety.drive_ms),
                           session_, clock_, metrics_);
  return std::make_shared<ConnectedSender>(*number, std::move(membership), session_,
                                           std::chrono::milliseconds(config_.safety.heartbeat_timeout_ms),
                                           std::move(pipeline), clock_, [this](bool replaced) {
                                             events_received_.add();
                                             if (replaced) events_replaced_.add();
                                             bell_.put(true);
                                           });
}

ExitCode PassiveDaemon::run(Signals& signals, const ConfigReload<PassiveConfig>& configuration) {
  control_->start();
  pages_.start();
  panel_->start();  // before anything can be driven
  drive_thread_ = std::thread([this] { drive_loop(); });
  notifier_.ready();
  spdlog::info("telehug-passive {} runs; jacket: {} on {}", version, profile_.name, config_.jacket.link);
  for (const auto& sender : senders_.all())
    spdlog::info("{}", describe(sender->membership()));
  for (const std::string& pair : left_out_)
    spdlog::error("{}", pair);
  if (!config_.consent.quiet_hours.empty()) spdlog::info("quiet hours: {}", config_.consent.quiet_hours);
  for (const std::string& note : profile_.notes)
    spdlog::info("{}", note);
  for (const std::string& problem : panel_->status().problems)
    spdlog::warn("{}", problem);
  bool paired = true;
  while (true) {
    notifier_.keeps_house(clock_.now());
    const auto request = signals.wait(housekeeping_round);
    if (request == SignalRequest::stop) break;
    if (request == SignalRequest::reload) reload(configuration);
    paired = follow_pairs();
    if (!paired) break;
    stop_.keep(clock_.now());
    tzset();  // follows a time zone that is changed meanwhile; looks at no more than the file's date if it is not
    tell_watchers();
    tell_running_to_all();
    tell_pages();
    tell_of_limits();
    answer_hug_button();
    keep_connections();
  }
  notifier_.stopping();
  end_thread();
  stop_.keep(clock_.now());
  spdlog::info("telehug-passive ends; the jacket is off");
  return paired ? ExitCode::ok : ExitCode::pair_ended;
}

void PassiveDaemon::reload(const ConfigReload<PassiveConfig>& configuration) {
  notifier_.reloading(clock_.now());
  configuration.again(config_, reload_notes_, [this](const PassiveConfig& next) -> Status {
    auto hours = parse_quiet_hours(next.consent.quiet_hours);
    if (!hours) return hours.error();
    if (next.consent.quiet_hours != config_.consent.quiet_hours) consent_.set_configured_quiet_hours(*std::move(hours));
    config_.consent.quiet_hours = next.consent.quiet_hours;
    config_.log = next.log;
    return Done{};
  });
  notifier_.ready();
}

bool PassiveDaemon::follow_pairs() {
  const auto ending = [this](ConnectedSender& sender, const std::string& why) {
    log_about({.stage = "pairing", .peer = sender.name()}, spdlog::level::err, why);
    // A stop outlives whoever said it.
    if (sender.connection.stopped_by_peer() && !stop_.stopped())
      stop_.stop({{"reason", sender.name() + " had stopped everything before the pair ended"}});
  };
  return senders_.follow_pairs(wall_time(), ending,
                               [](ConnectedSender& sender) { sender.connection.tell_pair_over(); });
}

void PassiveDaemon::end_thread() {
  pages_.stop();
  ending_ = true;
  if (drive_thread_.joinable()) drive_thread_.join();
  panel_->stop();
  // The queue's own destructor (Boost 1.74) does not destroy what it holds.
  felt_.consume_all([](const GivenAnswer&) {});
  senders_.close();
}

// --- drive thread ---

void PassiveDaemon::drive_loop() {
  while (!ending_) {
    bell_.wait_and_take(clock_.now() + drive_round);
    adopt_senders();
    follow_consent();
    // The safety stage takes a time that goes back for a fault: each call gets the present one.
    for (const auto& sender : senders_.adopted())
      hear(*sender, clock_.now());
    follow_stops(clock_.now());
    for (const auto& sender : senders_.adopted())
      process_newest_event(*sender);
    for (const auto& sender : senders_.adopted())
      sender->pipeline.tick(clock_.now());
    follow_trial(clock_.now());
    const Timestamp now = clock_.now();
    safety_.tick(now);
    tell_running(now);
    tell_state(now);
    tell_panel(now);
    notifier_.alive(now);
  }
  safety_.stop("telehug-passive ends", clock_.now());
}

void PassiveDaemon::adopt_senders() {
  if (!senders_.adopt()) return;
  const auto before = std::exchange(driven_, {});
  for (const auto& sender : senders_.adopted())
    driven_[sender->number] = true;
  for (SenderNumber number = 0; number < max_senders; ++number)
    if (before[number] && !driven_[number]) safety_.forget(number, clock_.now());
}

void PassiveDaemon::hear(ConnectedSender& sender, Timestamp now) {
  const auto heard = sender.connection.serve(now);
  if (!heard) return;
  sender.pipeline.observe(heard->heartbeat, heard->time);
  // One that has waited here while this thread was held up vouches for nothing any more.
  if (now - heard->time < oldest_heartbeat) safety_.on_heartbeat(sender.number, now);
}

void PassiveDaemon::process_newest_event(ConnectedSender& sender) {
  const auto arrival = sender.newest_event.take();
  if (!arrival) return;
  // Only the session whose heartbeats are heard may touch: another's would vouch for it.
  if (arrival->event.session != sender.connection.peer_session()) {
    events_unvouched_.add();
    return;
  }
  for (const Felt& felt : sender.pipeline.process(arrival->event, arrival->time)) {
    sender.connection.write(felt);
    own_state_.last_felt = felt;
    felt_.push({felt, sender.number});
  }
  own_state_.last_gesture = sender.pipeline.last_gesture();
  total_latency_.record(clock_.now() - arrival->time);
}

void PassiveDaemon::follow_stops(Timestamp now) {
  const bool own = stop_.stopped();
  const auto& senders = senders_.adopted();
  const auto stopper =
      std::ranges::find_if(senders, [](const auto& sender) { return sender->connection.stopped_by_peer(); });
  const bool stop = own || stopper != senders.end();
  if (stop == safety_.stopped()) return;
  if (!stop) {
    safety_.resume();
    return;
  }
  safety_.stop(own ? stop_.reason() : (*stopper)->name() + " has stopped everything", now);
}

// Local time is asked for once a second: libc looks it up under a lock, which others hold for a moment only.
void PassiveDaemon::follow_consent() {
  if (const auto wanted = consent_.take()) wanted_ = *wanted;
  if (const WallTime wall = wall_time(); wall != wall_) {
    wall_ = wall;
    local_minute_now_ = local_minute(wall);
  }
  const Permission permission = permission_at(wanted_, wall_, local_minute_now_);
  if (permission == safety_.permission()) return;
  safety_.permit(permission, clock_.now());
  for (const auto& sender : senders_.adopted())
    sender->pipeline.forget_touches(clock_.now());
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
  own_state_.heaters = safety_.heaters();
  own_state_.duties = safety_.duties();
  for (const auto& sender : senders_.adopted())
    sender->connection.tell_state(now);
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

std::vector<ConnectionStatus> PassiveDaemon::connections() const {
  std::vector<ConnectionStatus> connections;
  for (const auto& sender : senders_.all())
    connections.push_back(sender->connection.status());
  return connections;
}

void PassiveDaemon::keep_connections() {
  const DriveThreadState now = state();
  SideStatus own;
  own.session = session_;
  own.side = Side::passive;
  own.version = version;
  own.stopped = now.stopped;
  const std::string refusal = refusal_text(consent_.consent(), wall_time());
  own.ready = now.link.state == LinkState::armed && !now.stopped && refusal.empty();
  own.reason = stop_.stopped()    ? stop_.reason()
               : now.stopped      ? now.stop_reason
               : own.ready        ? ""
               : !refusal.empty() ? refusal + " (the wearer's own time)"
                                  : "no jacket answers: " + now.link.problem;
  for (const auto& sender : senders_.all())
    sender->connection.keep(own, stop_, wall_time());
}

}  // namespace telehug
