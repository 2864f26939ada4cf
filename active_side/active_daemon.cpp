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

constexpr Duration housekeeping_round = 20ms;
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
      stop_(stop_file(config.control, Side::active)),
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

ExitCode ActiveDaemon::run(Signals& signals, const ConfigReload<ActiveConfig>& configuration) {
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
    notifier_.keeps_house(clock_.now());
    const auto request = signals.wait(housekeeping_round);
    if (request == SignalRequest::stop) break;
    paired = follow_pairs();
    if (!paired) break;
    stop_.keep(clock_.now());
    if (request == SignalRequest::reload) reload(configuration);
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
  stop_.keep(clock_.now());
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

// --- housekeeping ---

// What was set up from a page is in use at once, as if the daemon had been started with it.
void ActiveDaemon::adopt_setup() {
  const auto saved = setup_->take_saved();
  if (!saved) return;
  config_.rig.screen = saved->screen;
  config_.camera.source = saved->camera;
  if (!saved->monitor.empty()) show_monitor(saved->monitor);
  auto camera = setup_->open(*saved);
  {
    const std::lock_guard lock(words_mutex_);
    if (camera) camera_name_ = (*camera)->name();
    setup_problem_ = camera ? "" : "the camera that was set up can't be used: " + camera.error().message;
  }
  if (camera) {
    new_camera_.put(*std::move(camera));
  } else {
    log_about({.stage = "camera"}, spdlog::level::err, camera.error().message);
  }
  calibration_time_.reset();
}

void ActiveDaemon::show_monitor(const std::string& monitor) {
  if (monitor == config_.body_map.monitor) return;
  config_.body_map.monitor = monitor;
  if (overlay_) overlay_.emplace(X11OverlayConfig{.display = {}, .monitor = monitor}, clock_);
}

void ActiveDaemon::reload(const ConfigReload<ActiveConfig>& configuration) {
  notifier_.reloading(clock_.now());
  bool new_rig = false;
  configuration.again(config_, reload_notes_, [&](const ActiveConfig& next) -> Status {
    std::string problem = use_rig(next);
    new_rig = problem.empty();
    // Without a rig there is nothing that a new configuration could break.
    if (!new_rig && rig_problem_.empty()) return Error{std::move(problem)};
    show_monitor(next.body_map.monitor);
    config_.touch = next.touch;
    config_.body_map = next.body_map;
    config_.hug = next.hug;
    config_.log = next.log;
    return Done{};
  });
  if (!new_rig) calibration_time_.reset();
  notifier_.ready();
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

  std::string problem = use_rig(config_);
  if (problem.empty()) return;
  say_rig_.say(spdlog::level::warn, problem, {.stage = "calibration"});
  const std::lock_guard lock(words_mutex_);
  rig_problem_ = std::move(problem);
  face_note_.clear();
}

std::string ActiveDaemon::use_rig(const ActiveConfig& config) {
  auto rig = make_rig(config, touches_, clock_, metrics_, rigs_made_++ * versions_a_rig);
  if (!rig) return rig.error().message;
  const std::string& note = (*rig)->note;
  say_rig_.say(note.empty() ? spdlog::level::info : spdlog::level::warn,
               fmt::format("calibration: {}{}{}", calibration_path_.string(), note.empty() ? "" : "; ", note),
               {.stage = "calibration"});
  face_workers_.push_back((*rig)->face);
  {
    const std::lock_guard lock(words_mutex_);
    rig_problem_.clear();
    face_note_ = (*rig)->face_note;
  }
  new_rig_.put(*std::move(rig));
  return {};
}

bool ActiveDaemon::follow_pairs() {
  return wearers_.follow_pairs(
      wall_time(),
      [](const ConnectedWearer& wearer, const std::string& why) {
        log_about({.stage = "pairing", .peer = wearer.name()}, spdlog::level::err, why);
      },
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
