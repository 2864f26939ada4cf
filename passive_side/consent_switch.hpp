// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "common/latest_slot.hpp"
#include "jacket/jacket_profile.hpp"
#include "safety/consent.hpp"
#include "service/control_server.hpp"

namespace telehug {

inline constexpr int longest_pause_min = 24 * 60;  // one without an end is longer

// What the wearer wants: set on the local socket, kept in a file, followed by the drive thread.
class ConsentSwitch {
 public:
  // What was kept in `file`. If that can't be read everything is paused.
  ConsentSwitch(std::filesystem::path file, QuietHours hours, const JacketProfile& profile);

  // Adds the commands "pause", "unpause", "mute", "unmute", "strength" and "quiet" to `control`. `changed`: called
  // after each change, on the thread of the control server; both outlive it.
  void serve(ControlServer& control, std::function<void()> changed);

  // --- control thread: what the commands do; each takes effect before it is kept ---

  nlohmann::json pause(const nlohmann::json& request, std::chrono::sys_seconds now);
  nlohmann::json unpause();
  nlohmann::json mute(const nlohmann::json& request, bool muted);
  nlohmann::json strength(const nlohmann::json& request);
  nlohmann::json quiet(const nlohmann::json& request);

  // --- housekeeping thread ---

  // The configuration's quiet hours are others now; the wearer's own stay.
  void set_configured_quiet_hours(QuietHours hours);

  // --- drive thread ---

  // What is wanted, if that has changed since the last call.
  [[nodiscard]] std::optional<Consent> take() { return newest_.try_take(); }

  // --- any thread ---

  [[nodiscard]] Consent consent() const;
  // Why it can't be read or kept, and what to do: {"what", "do"}; null if it can.
  [[nodiscard]] nlohmann::json problem() const;

 private:
  nlohmann::json set(Consent consent, nlohmann::json answer);

  const std::filesystem::path file_;
  const JacketProfile& profile_;
  std::function<void()> changed_ = [] {};
  LatestSlot<Consent> newest_;
  mutable std::mutex mutex_;
  Consent consent_;         // guarded by mutex_
  nlohmann::json problem_;  // likewise
};

// One sentence without a full stop on why nothing is felt at this moment: "paused until 15:30"; empty if it may be.
[[nodiscard]] std::string refusal_text(const Consent& consent, std::chrono::sys_seconds now);

// For status: {"name": "open" | "paused" | "quiet hours", "why", "until", "strength", "quiet_hours",
// "own_quiet_hours", "muted_boxes", "muted_actuators"}, those that say nothing left out.
[[nodiscard]] nlohmann::json consent_json(const Consent& consent, std::chrono::sys_seconds now);

}  // namespace telehug
