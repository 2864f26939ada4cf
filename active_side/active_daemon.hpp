// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <boost/lockfree/spsc_queue.hpp>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "capture/frame_source.hpp"
#include "common/latest_slot.hpp"
#include "common/version.hpp"
#include "config/config.hpp"
#include "connected_wearer.hpp"
#include "daemon/config_reload.hpp"
#include "daemon/connections.hpp"
#include "daemon/pairing_desk.hpp"
#include "daemon/stop_switch.hpp"
#include "feedback/felt_feedback.hpp"
#include "finger_feed.hpp"
#include "live_touches.hpp"
#include "local_touch/local_touch.hpp"
#include "notify/desktop_notifier.hpp"
#include "overlay/x11_hotkey.hpp"
#include "overlay/x11_overlay.hpp"
#include "publish/touch_stream.hpp"
#include "rig.hpp"
#include "sending_switch.hpp"
#include "service/control_server.hpp"
#include "service/exit_code.hpp"
#include "service/log.hpp"
#include "service/metrics.hpp"
#include "service/notifier.hpp"
#include "service/signals.hpp"
#include "setup_run/setup_desk.hpp"
#include "touched_box.hpp"
#include "web/daemon_pages.hpp"

namespace telehug {

// One contact of an event that was sent, for those who watch.
struct SentTouch {
  std::uint64_t event_sequence = 0;
  std::int64_t frame_time_ns = 0;
  std::uint64_t frame_sequence = 0;
  Contact contact;
};

// What the touch thread tells of itself, for status.
struct TouchThreadState {
  bool camera_open = false;
  bool camera_lost = false;
  bool recording_over = false;
  std::string camera_problem;
  std::string camera_setup;
  FrameVerdict picture = FrameVerdict::good;
  std::shared_ptr<FaceWorker> face;
  std::string detector;                                   // in use; empty: there is no calibration
  std::string model;                                      // likewise
  std::string calibrated;                                 // when: ISO 8601, UTC; likewise
  std::optional<ScreenSize> screen;                       // likewise
  std::shared_ptr<const std::vector<ScreenPoint>> reach;  // on it; null: not known
  bool knows_background = true;
  NobodyTouched nobody;
  std::uint64_t withheld = 0;  // touches that did not go out because of the sending switch
  DriftState camera_drift = DriftState::steady;
  std::optional<SentTouch> last_touch;
};

// A wearer's hug, and whose it was.
struct SeenHug {
  ShownHug hug;
  std::string from;
};

// The parent's PC: one thread for the touch path, one for the face (FaceWorker), the calling one for everything that
// may take its time. Touches go to every wearer who is connected. The camera is open only while one is, or this PC or
// one of its pages uses the touches itself, and the screen is looked at only while one is.
class ActiveDaemon {
 public:
  // Throws AlreadyRunning, std::runtime_error or std::invalid_argument with a sentence for a person.
  // `feedback` may be null. `setup`: for set-ups from the pages.
  ActiveDaemon(const ActiveConfig& config, Memberships memberships, std::unique_ptr<FrameSource> camera,
               std::unique_ptr<FeltFeedback> feedback, SetupTools setup, const Clock& clock);
  ~ActiveDaemon();
  ActiveDaemon(const ActiveDaemon&) = delete;
  ActiveDaemon& operator=(const ActiveDaemon&) = delete;

  // Until SIGTERM or SIGINT. SIGHUP reads configuration and calibration anew.
  ExitCode run(Signals& signals, const ConfigReload<ActiveConfig>& configuration);

 private:
  using Wearers = Connections<ConnectedWearer>;

  void end_thread();

  // Touch thread
  [[nodiscard]] bool anybody_listens(Timestamp now);
  void touch_loop();
  void hear(ConnectedWearer& wearer, Timestamp now);
  void serve_hugs(Timestamp now);
  void adopt_rig();
  void adopt_camera();
  [[nodiscard]] bool camera_wanted(Timestamp now);
  [[nodiscard]] bool used_by_page() const;  // any thread
  void take_frame();
  void rest();
  void judge_sending(bool screen_known);
  void hold_back();
  bool send(const TouchEvent& event);
  void publish(const TouchEvent* event, std::uint64_t frame_sequence);
  void tell_state(Timestamp now);

  // Housekeeping
  void adopt_setup();
  void reload(const ConfigReload<ActiveConfig>& configuration);
  void show_monitor(const std::string& monitor);
  void load_rig_if_changed();
  // Empty, or why there is none; then what was in use before still is.
  [[nodiscard]] std::string use_rig(const ActiveConfig& config);
  void tell_watchers();
  void tell_pages();
  void tell_local_touch();
  void show_touched_box(const FaceState& face, FaceWorker* worker);
  void serve_desktop();
  void show_hugs();
  [[nodiscard]] bool follow_pairs();
  void keep_connections();
  [[nodiscard]] std::vector<ConnectionStatus> connections() const;
  [[nodiscard]] std::string why_stopped() const;  // any thread; empty: nobody has
  void answer_commands();
  nlohmann::json order_face(const nlohmann::json& request);
  nlohmann::json order_hug(const nlohmann::json& request);
  nlohmann::json status() const;
  [[nodiscard]] nlohmann::json sending_json(const TouchThreadState& state) const;
  [[nodiscard]] nlohmann::json last_hug_json() const;
  nlohmann::json problems(const TouchThreadState& state, const FaceState& face,
                          const std::vector<ConnectionStatus>& connections) const;

  ActiveConfig config_;                      // what changes of it the housekeeping thread alone looks at
  const std::vector<std::string> left_out_;  // pairs that could not be used at the start, and why
  const Clock& clock_;
  Timestamp started_;
  SessionId session_;
  MetricsRegistry metrics_;
  Notifier notifier_;

  std::unique_ptr<FrameSource> camera_;  // of the touch thread

  // Touch thread
  TouchStream touches_;
  std::unique_ptr<Rig> rig_;
  Frame frame_;
  BodyMap map_;
  bool camera_lost_ = false;
  bool recording_over_ = false;
  bool sending_ = false;
  bool withholding_ = false;  // touches would go out but for the sending switch
  Timestamp told_state_;
  TouchThreadState own_state_;
  Counter& events_published_;
  Counter& touches_published_;
  Counter& publish_failed_;
  Counter& frames_broken_;
  Counter& frames_missed_;
  Counter& camera_losses_;
  Counter& hugs_begun_;
  LatencyHistogram& camera_latency_;
  LatencyHistogram& publish_latency_;
  LatencyHistogram& total_latency_;

  // Between the threads
  LatestSlot<std::unique_ptr<Rig>> new_rig_;
  LatestSlot<std::unique_ptr<FrameSource>> new_camera_;
  LocalTouch local_touch_;
  FingerFeed fingers_;
  StopSwitch stop_;
  SendingSwitch sending_switch_;
  std::atomic<bool> ending_ = false;
  mutable std::mutex state_mutex_;
  TouchThreadState state_;
  boost::lockfree::spsc_queue<SentTouch, boost::lockfree::capacity<1024>> sent_touches_;
  LatestSlot<HugOrder> hug_order_;
  boost::lockfree::spsc_queue<SeenHug, boost::lockfree::capacity<16>> shown_hugs_;

  // Housekeeping
  ReloadNotes reload_notes_{Side::active};
  const std::filesystem::path calibration_path_;
  std::optional<std::filesystem::file_time_type> calibration_time_;
  Timestamp calibration_looked_at_;
  // Of all rigs that may still be in use: the last one to let go of a face worker waits for its thread, and that must
  // not be the touch thread.
  std::vector<std::shared_ptr<FaceWorker>> face_workers_;
  std::uint32_t rigs_made_ = 0;
  mutable std::mutex words_mutex_;  // guards the sentences below, which the control thread reads
  std::string camera_name_;
  std::string rig_problem_;
  std::string setup_problem_;
  std::string face_note_;
  std::optional<SeenHug> last_hug_;
  std::string hug_problem_;  // why it was not seen on the desktop
  bool told_recording_over_ = false;
  TouchedBox touched_box_;
  LiveTouches live_touches_;
  Timestamp told_pages_;
  std::optional<X11Overlay> overlay_;  // if it is wanted
  std::optional<X11Hotkey> hotkey_;    // likewise
  Timestamp desktop_served_;
  std::string desktop_problem_;  // of these two; guarded by words_mutex_
  SayOnChange say_camera_;
  SayOnChange say_face_;
  SayOnChange say_rig_;
  SayOnChange say_local_touch_;
  const std::unique_ptr<FeltFeedback> feedback_;
  SayOnChange say_feedback_;
  DesktopNotifier desktop_notifier_;
  Timestamp glows_until_;  // the overlay, after a hug
  SayOnChange say_desktop_;
  SayOnChange say_hug_;

  Wearers wearers_;
  std::optional<PairingDesk> pairing_;  // these two end after what asks them
  std::optional<SetupDesk> setup_;
  std::unique_ptr<ControlServer> control_;
  DaemonPages pages_;
  std::thread touch_thread_;
};

}  // namespace telehug
