// SPDX-License-Identifier: Apache-2.0
#include "active_daemon.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "active_pages.hpp"
#include "config/places.hpp"
#include "daemon/daemon_settings.hpp"
#include "local_outputs.hpp"
#include "peer/session_id.hpp"

namespace telehug {
namespace {

constexpr Duration longest_wait_for_a_frame = 50ms;  // heartbeats go out between frames
constexpr Duration resting_round = 20ms;
constexpr Duration housekeeping_round = 20ms;
constexpr Duration state_interval = 100ms;
constexpr Duration calibration_interval = 1s;
// At 8 looks a second the grid moves less often than that in a day and a half.
constexpr std::uint32_t versions_a_rig = 1U << 20U;

}  // namespace

ActiveDaemon::ActiveDaemon(const ActiveConfig& config, Memberships memberships, std::unique_ptr<FrameSource> camera,
                           std::unique_ptr<FeltFeedback> feedback, SetupTools setup, const Clock& clock)
    : config_(config),
      left_out_(std::move(memberships.left_out)),
      clock_(clock),
      started_(clock.now()),
      session_(new_session_id()),
      camera_(std::move(camera)),
      touches_(session_),
      events_published_(metrics_.counter("events_published")),
      touches_published_(metrics_.counter("touches_published")),
      publish_failed_(metrics_.counter("events_not_published")),
      frames_broken_(metrics_.counter("frames_broken")),
      frames_missed_(metrics_.counter("frames_missed")),
      camera_losses_(metrics_.counter("camera_losses")),
      hugs_begun_(metrics_.counter("hugs_begun")),
      camera_latency_(metrics_.latency("camera")),
      publish_latency_(metrics_.latency("publish")),
      total_latency_(metrics_.latency("frame_to_published")),
      local_touch_(local_outputs(config.local_touch), clock),
      sending_switch_(config.sending.at_start, config.sending.only_in_front),
      calibration_path_(rig_file(config.rig)),
      camera_name_(camera_->name()),
      feedback_(std::move(feedback)),
      desktop_notifier_(clock),
      wearers_(PairsWatch(config.peer, Side::active, clock),
               [this](Membership membership, const Wearers::List&) {
                 return std::make_shared<ConnectedWearer>(
                     std::move(membership), session_, std::chrono::milliseconds(config_.heartbeat_timeout_ms), clock_);
               }),
      control_(std::make_unique<ControlServer>(control_options(config.control, Side::active))),
      pages_(config.web, active_pages_options([this] { return setup_->picture(); }), *control_, clock) {
  pairing_.emplace(Side::active, pairs_folder(config.peer, Side::active), config.peer.loopback_only ? "127.0.0.1" : "",
                   *control_);
  setup_.emplace(SetupDeskSettings{.config = config,
                                   .tools = std::move(setup),
                                   .cameras = [camera = config.camera] { return offered_cameras(camera); },
                                   .monitors = monitors_of_display,
                                   .why_stopped = [this] { return why_stopped(); }},
                 *control_);
  if (config_.overlay.show)
    overlay_.emplace(X11OverlayConfig{.display = {}, .monitor = config_.body_map.monitor}, clock);
  if (!config_.sending.hotkey.empty())
    hotkey_.emplace(X11HotkeyConfig{.display = {}, .keys = config_.sending.hotkey}, clock);
  answer_commands();
  wearers_.open(std::move(memberships.members));
}

ActiveDaemon::~ActiveDaemon() {
  end_thread();
  control_.reset();  // its handlers use the pages
}

ExitCode ActiveDaemon::run(Signals& signals) {
  load_rig_if_changed();
  control_->start();
  pages_.start();
  touch_thread_ = std::thread([this] { touch_loop(); });
  notifier_.ready();
  spdlog::info("telehug-active {} runs; camera: {}", version, camera_name_);
  for (const auto& wearer : wearers_.all())
    spdlog::info("{}", describe(wearer->membership()));
  for (const std::string& pair : left_out_)
    spdlog::error("{}", pair);
  bool paired = true;
  while (true) {
    const auto request = signals.wait(housekeeping_round);
    if (request == SignalRequest::stop) break;
    paired = follow_pairs();
    if (!paired) break;
    if (request == SignalRequest::reload) calibration_time_.reset();
    adopt_setup();
    load_rig_if_changed();
    tell_watchers();
    tell_pages();
    tell_local_touch();
    serve_desktop();
    show_hugs();
    keep_connections();
  }
  notifier_.stopping();
  end_thread();
  spdlog::info("telehug-active ends");
  return paired ? ExitCode::ok : ExitCode::pair_ended;
}

void ActiveDaemon::end_thread() {
  pages_.stop();
  ending_ = true;
  if (touch_thread_.joinable()) touch_thread_.join();
  // The queue's own destructor (Boost 1.74) does not destroy what it holds.
  shown_hugs_.consume_all([](const SeenHug&) {});
  wearers_.close();
}

// --- touch thread ---

void ActiveDaemon::touch_loop() {
  while (!ending_) {
    const Timestamp now = clock_.now();
    wearers_.adopt();
    for (const auto& wearer : wearers_.adopted())
      hear(*wearer, now);
    serve_hugs(now);
    adopt_rig();
    adopt_camera();
    if (camera_wanted(now)) {
      take_frame();
    } else {
      rest();
    }
    if (rig_) fingers_.put(rig_->pipeline.contacts(), rig_->pipeline.time());
    tell_state(now);
    notifier_.alive(now);
  }
  camera_->close();
  touches_.hug().break_off();
  publish(touches_.build(clock_.now()), 0);
}

void ActiveDaemon::adopt_rig() {
  auto fresh = new_rig_.try_take();
  if (!fresh) return;
  publish(touches_.build(clock_.now()), 0);  // what the old one's fingers touched is over
  rig_ = *std::move(fresh);
  map_ = {};
}

void ActiveDaemon::adopt_camera() {
  auto fresh = new_camera_.try_take();
  if (!fresh) return;
  camera_->close();
  camera_ = *std::move(fresh);
  camera_lost_ = false;
}

void ActiveDaemon::hear(ConnectedWearer& wearer, Timestamp now) {
  HugInbox& hugs = wearer.connection.beside().hugs();
  if (const auto heard = wearer.connection.serve(now)) hugs.observe(*heard);
  if (const auto hug = hugs.take()) shown_hugs_.push({*hug, wearer.membership().pair ? wearer.name() : "The wearer"});
}

bool ActiveDaemon::anybody_listens(Timestamp now) {
  return std::ranges::any_of(wearers_.adopted(), [now](const auto& wearer) { return wearer->listens(now); });
}

bool ActiveDaemon::camera_wanted(Timestamp now) {
  if (setup_->camera().wanted()) {  // who touches dots touches nobody
    if (rig_) rig_->face->want(false);
    judge_sending(false);
    return false;
  }
  // Switched off by hand, the camera is not needed; covered by another window the chat may be back at once.
  const bool touches_go_out =
      rig_ && anybody_listens(now) && !stop_.stopped() && sending_switch_.mode() != SendingMode::off;
  const bool used_here = rig_ && (local_touch_.on() || fingers_.wanted()) && !stop_.stopped();
  if (!touches_go_out && !used_here) recording_over_ = false;
  if (rig_) rig_->face->want(touches_go_out && !recording_over_);
  // Before it is known where the remote person is, fingers mean nothing to the other side.
  const bool screen_known = touches_go_out && rig_->face->has_looked();
  judge_sending(screen_known);
  return (screen_known || used_here) && !recording_over_;
}

// What touches the screen is meant for a page of this PC.
bool ActiveDaemon::used_by_page() const {
  return fingers_.wanted() || setup_->camera().touched_here();
}

void ActiveDaemon::take_frame() {
  const std::uint64_t before = frame_.sequence;
  if (!camera_->is_open()) {
    frame_.sequence = 0;
    (void)camera_->open();  // read() says why it could not
  }
  camera_->need_rows(rig_->pipeline.rows_needed());
  const ReadOutcome outcome = camera_->read(frame_, longest_wait_for_a_frame);
  rig_->face->update(map_);
  judge_sending((sending_ || withholding_) && !stop_.stopped());  // the read may have taken its time
  if (outcome == ReadOutcome::lost && !camera_lost_) camera_losses_.add();
  camera_lost_ = outcome == ReadOutcome::lost;
  switch (outcome) {
    case ReadOutcome::frame:
      camera_latency_.record(clock_.now() - frame_.time);
      if (before != 0 && frame_.sequence > before + 1) frames_missed_.add(frame_.sequence - before - 1);
      publish(rig_->pipeline.process(frame_, map_, sending_), frame_.sequence);
      hold_back();
      return;
    case ReadOutcome::broken:
      frames_broken_.add();
      break;
    case ReadOutcome::timeout:
      break;
    case ReadOutcome::ended:
      recording_over_ = true;
      camera_->close();
      break;
    case ReadOutcome::lost:
      std::this_thread::sleep_for(resting_round);
      break;
  }
  publish(rig_->pipeline.process_nothing(map_, sending_), frame_.sequence);
}

void ActiveDaemon::rest() {
  camera_->close();
  camera_lost_ = false;
  if (rig_) rig_->face->update(map_);
  publish(rig_ ? rig_->pipeline.process_nothing(map_, false) : touches_.build(clock_.now()), frame_.sequence);
  setup_->camera().let_go();
  std::this_thread::sleep_for(resting_round);
}

void ActiveDaemon::judge_sending(bool screen_known) {
  const bool sends = screen_known && sending_switch_.judge(rig_->face->view(), used_by_page()) == SendingVerdict::sends;
  sending_ = sends;
  withholding_ = screen_known && !sends;
}

// What touches the screen while touches don't go out touches nobody until it is lifted: a finger that closes the window
// in front of the chat, a cloth, a stroke on this PC's own programs.
void ActiveDaemon::hold_back() {
  const bool kept_here = sending_switch_.mode() == SendingMode::off || used_by_page();
  if (!withholding_ && !kept_here) return;
  rig_->pipeline.hold_back_contacts();
  for (const ContactState& contact : rig_->pipeline.contacts())
    if (contact.phase == Phase::down) ++own_state_.withheld;
}

// To everybody, also to who has stopped it: the ends of what they felt must reach them. False if it went out to nobody.
bool ActiveDaemon::send(const TouchEvent& event) {
  bool sent = false;
  for (const auto& wearer : wearers_.adopted())
    sent = wearer->connection.write(event) || sent;
  return sent;
}

void ActiveDaemon::publish(const TouchEvent* event, std::uint64_t frame_sequence) {
  if (rig_) local_touch_.put(rig_->pipeline.contacts(), rig_->pipeline.screen(), clock_.now());
  if (event == nullptr) return;
  const Timestamp started = clock_.now();
  if (!send(*event)) {
    publish_failed_.add();
    return;
  }
  const Timestamp published = clock_.now();
  publish_latency_.record(published - started);
  events_published_.add();
  if (!event->contacts.empty()) total_latency_.record(published - from_ns(event->frame_time_ns));
  for (const Contact& contact : event->contacts) {
    const SentTouch sent{event->sequence, event->frame_time_ns, frame_sequence, contact};
    own_state_.last_touch = sent;
    if (contact.phase == Phase::down) touches_published_.add();
    sent_touches_.push(sent);
  }
  // An up of a contact that left the grid stands only among the transitions.
  for (const Transition& transition : event->transitions) {
    const bool known = std::any_of(event->contacts.begin(), event->contacts.end(),
                                   [&](const Contact& contact) { return contact.id == transition.contact.id; });
    if (transition.event_sequence == event->sequence && !known) {
      sent_touches_.push({event->sequence, event->frame_time_ns, frame_sequence, transition.contact});
    }
  }
}

void ActiveDaemon::tell_state(Timestamp now) {
  if (now - told_state_ < state_interval) return;
  const std::unique_lock lock(state_mutex_, std::try_to_lock);
  if (!lock.owns_lock()) return;
  told_state_ = now;
  own_state_.camera_open = camera_->is_open() && !camera_lost_;
  own_state_.camera_lost = camera_lost_;
  own_state_.recording_over = recording_over_;
  own_state_.camera_problem = camera_->last_error();
  own_state_.camera_setup = camera_->is_open() ? camera_->setup() : "";
  own_state_.face = rig_ ? rig_->face : nullptr;
  own_state_.detector = rig_ ? rig_->detector : "";
  own_state_.model = rig_ ? rig_->model : "";
  own_state_.screen = rig_ ? std::optional(rig_->pipeline.screen()) : std::nullopt;
  own_state_.calibrated = rig_ ? rig_->calibrated : "";
  own_state_.reach = rig_ ? rig_->reach : nullptr;
  own_state_.knows_background = !rig_ || rig_->pipeline.knows_background();
  for (const auto& wearer : wearers_.adopted())
    wearer->connection.tell_state(now);
  own_state_.picture = rig_ && own_state_.camera_open ? rig_->pipeline.verdict() : FrameVerdict::good;
  if (rig_) own_state_.nobody = rig_->pipeline.nobody_touched();
  own_state_.camera_drift = rig_ ? rig_->pipeline.camera_drift() : DriftState::steady;
  state_ = own_state_;
}

// --- housekeeping ---

// What was set up from a page is in use at once, as if the daemon had been started with it.
void ActiveDaemon::adopt_setup() {
  const auto saved = setup_->take_saved();
  if (!saved) return;
  config_.rig.screen = saved->screen;
  config_.camera.source = saved->camera;
  if (!saved->monitor.empty() && saved->monitor != config_.body_map.monitor) {
    config_.body_map.monitor = saved->monitor;
    if (overlay_) overlay_.emplace(X11OverlayConfig{.display = {}, .monitor = saved->monitor}, clock_);
  }
  auto camera = setup_->open(*saved);
  {
    const std::lock_guard lock(words_mutex_);
    if (camera) camera_name_ = (*camera)->name();
    setup_problem_ = camera ? "" : "the camera that was set up can't be used: " + camera.error().message;
  }
  if (camera) {
    new_camera_.put(*std::move(camera));
  } else {
    spdlog::error("{}", camera.error().message);
  }
  calibration_time_.reset();
}

void ActiveDaemon::load_rig_if_changed() {
  std::erase_if(face_workers_, [](const auto& worker) { return worker.use_count() == 1; });
  const Timestamp now = clock_.now();
  if (calibration_time_ && now - calibration_looked_at_ < calibration_interval) return;
  calibration_looked_at_ = now;
  std::error_code no_file;
  const auto time = std::filesystem::last_write_time(calibration_path_, no_file);
  if (calibration_time_ == time) return;
  calibration_time_ = time;

  auto rig = make_rig(config_, touches_, clock_, metrics_, rigs_made_++ * versions_a_rig);
  const std::string problem = rig ? "" : rig.error().message;
  const std::string face_note = rig ? (*rig)->face_note : "";
  if (rig) {
    const std::string& note = (*rig)->note;
    say_rig_.say(note.empty() ? spdlog::level::info : spdlog::level::warn,
                 fmt::format("calibration: {}{}{}", calibration_path_.string(), note.empty() ? "" : "; ", note));
    face_workers_.push_back((*rig)->face);
    new_rig_.put(*std::move(rig));
  } else {
    say_rig_.say(spdlog::level::warn, problem);
  }
  const std::lock_guard lock(words_mutex_);
  rig_problem_ = problem;
  face_note_ = face_note;
}

bool ActiveDaemon::follow_pairs() {
  return wearers_.follow_pairs(
      wall_time(), [](ConnectedWearer&, const std::string& why) { spdlog::error("{}", why); },
      [](ConnectedWearer& wearer) { wearer.connection.tell_pair_over(); });
}

std::vector<ConnectionStatus> ActiveDaemon::connections() const {
  std::vector<ConnectionStatus> connections;
  for (const auto& wearer : wearers_.all())
    connections.push_back(wearer->connection.status());
  return connections;
}

// As status tells it: here, or by everybody who is connected.
std::string ActiveDaemon::why_stopped() const {
  if (stop_.stopped()) return "everything is stopped here: resume first, here or by `telehug resume`";
  const auto connected = connections();
  const bool by_peers =
      !connected.empty() && std::ranges::all_of(connected, [](const auto& wearer) { return wearer.stopped_by_peer; });
  return by_peers ? "the other side has stopped everything: they resume first" : "";
}

void ActiveDaemon::keep_connections() {
  SideStatus own;
  own.session = session_;
  own.side = Side::active;
  own.version = version;
  own.stopped = stop_.stopped();
  {
    const std::lock_guard lock(words_mutex_);
    own.ready = rig_problem_.empty() && !own.stopped;
    own.reason = own.stopped ? stop_.reason() : rig_problem_;
  }
  for (const auto& wearer : wearers_.all())
    wearer->connection.keep(own, stop_, wall_time());
}

}  // namespace telehug
