// SPDX-License-Identifier: Apache-2.0
//
// Setting up for a daemon's pages, asked for by the command "setup" of the local socket (common/ctl/README.md). While
// one runs it has the camera, and touches rest.
#pragma once

#include <atomic>
#include <functional>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "config/config.hpp"
#include "service/control_server.hpp"
#include "setup_run/camera_handover.hpp"
#include "setup_run/live_jpeg.hpp"
#include "setup_run/newest_monitors.hpp"
#include "setup_run/setup_offers.hpp"
#include "setup_run/setup_run.hpp"

namespace telehug {

struct SetupDeskSettings {
  ActiveConfig config;  // camera, screen and monitor as they are, to begin with
  SetupTools tools;
  std::function<std::vector<OfferedCamera>()> cameras;
  std::function<std::vector<SizedMonitor>()> monitors;  // see NewestMonitors
  // Empty while nobody has stopped; who has, and what to do, while no set-up may run. From any thread.
  std::function<std::string()> why_stopped = [] { return std::string(); };
};

class SetupDesk {
 public:
  static constexpr Duration longest_unfollowed = 10s;  // then nobody looks any more, and it ends
  static constexpr Duration longest_idle = 15min;      // without an order or a step further: a page that is forgotten
  static constexpr Duration longest_handover = 5s;
  static constexpr Duration longest_silence = 10s;  // of the camera, which hangs then

  // Adds the command "setup" to `control`, which must end before this does.
  SetupDesk(SetupDeskSettings settings, ControlServer& control);
  ~SetupDesk();  // ends what runs
  SetupDesk(const SetupDesk&) = delete;
  SetupDesk& operator=(const SetupDesk&) = delete;

  // The touch thread's end of it.
  [[nodiscard]] CameraHandover& camera() noexcept { return handover_; }
  [[nodiscard]] const CameraHandover& camera() const noexcept { return handover_; }

  // --- any thread ---

  // If it has changed since it was last asked for: {"stage": "idle"}; "waiting" for the camera; "running" with what
  // SetupRun::state() says; "ended" with that and "why": "saved", "cancelled", "idle", "unfollowed", "stopped" or
  // "failed", and "problem". "waiting" and "running" with "hangs": true while the camera does.
  [[nodiscard]] std::optional<nlohmann::json> news();
  // The camera answers neither yes nor no. Nothing can end that but who unplugs it.
  [[nodiscard]] bool camera_hangs() const;
  // A page follows the news.
  void followed();
  [[nodiscard]] std::shared_ptr<const std::string> picture() { return picture_.newest(); }
  // The camera that was chosen, with the settings that were found for it.
  [[nodiscard]] Result<std::unique_ptr<FrameSource>> open(const SetupChoice& choice) const;
  // What was chosen and saved since it was last asked for.
  [[nodiscard]] std::optional<SetupChoice> take_saved();

 private:
  using Json = nlohmann::json;

  [[nodiscard]] Json obey(const Json& request);
  [[nodiscard]] Json list();
  [[nodiscard]] Json start(const Json& request);
  [[nodiscard]] Json pass_on(const std::string& order, const Json& request);
  [[nodiscard]] bool silent() const;  // with mutex_ held
  void work(const SetupChoice& choice);
  [[nodiscard]] Json carry_out(const SetupChoice& choice);
  void tell_end(Json end);
  [[nodiscard]] const char* reason_to_end();
  [[nodiscard]] bool goes_on(const Json& state);
  [[nodiscard]] std::vector<SetupOrder> take_orders();
  void tell(const char* stage, Json state);

  const SetupDeskSettings settings_;
  const Clock& clock_;
  CameraHandover handover_;
  LiveJpeg picture_;
  NewestMonitors monitors_;

  mutable std::mutex mutex_;  // guards what follows, up to worker_
  SetupChoice usual_;         // what a set-up begins with
  Json state_ = {{"stage", "idle"}};
  bool changed_ = true;
  bool told_hanging_ = false;
  bool runs_ = false;
  bool cancelled_ = false;
  std::vector<SetupOrder> orders_;
  Timestamp followed_;
  Timestamp went_on_;
  Timestamp alive_;  // the set-up's thread
  std::optional<SetupChoice> saved_;

  std::thread worker_;  // of the control server's thread
};

}  // namespace telehug
