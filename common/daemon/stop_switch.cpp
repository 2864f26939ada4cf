// SPDX-License-Identifier: Apache-2.0
#include "daemon/stop_switch.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "service/log.hpp"

namespace telehug {
namespace {

constexpr std::size_t longest_reason = 200;  // bytes

// Without control characters, and not cut within a UTF-8 character.
std::string one_line(std::string text) {
  std::size_t end = std::min(text.size(), longest_reason);
  while (end > 0 && end < text.size() && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U)
    --end;
  text.resize(end);
  std::ranges::replace_if(
      text, [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; }, ' ');
  return text;
}

std::string reason_in(const nlohmann::json& request) {
  const auto reason = request.find("reason");
  const bool given = reason != request.end() && reason->is_string() && !reason->get_ref<const std::string&>().empty();
  return given ? one_line(reason->get<std::string>()) : "stopped on this side";
}

void say_stopped(const std::string& reason) {
  log_about({.stage = "stop", .message_id = message_id::stopped}, spdlog::level::warn,
            fmt::format("stopped: {}", reason));
}

}  // namespace

void StopSwitch::serve(ControlServer& control) {
  control.on("stop", [this](const nlohmann::json& request) { return stop(request); });
  control.on("resume", [this](const nlohmann::json&) { return resume(); });
}

nlohmann::json StopSwitch::stop(const nlohmann::json& request) {
  std::string reason = reason_in(request);
  {
    const std::lock_guard lock(mutex_);
    set(true, reason);
  }
  say_stopped(reason);
  return {{"stopped", true}};
}

nlohmann::json StopSwitch::resume() {
  {
    const std::lock_guard lock(mutex_);
    if (obstacle_) return {{"error", *obstacle_}};
    set(false, "");
  }
  log_about({.stage = "stop", .message_id = message_id::resumed}, spdlog::level::warn, "resumed");
  return {{"stopped", false}};
}

void StopSwitch::hold(std::string reason, std::string obstacle) {
  {
    const std::lock_guard lock(mutex_);
    set(true, reason);
    obstacle_ = std::move(obstacle);
  }
  say_stopped(reason);
}

void StopSwitch::release() {
  const std::lock_guard lock(mutex_);
  obstacle_.reset();
}

void StopSwitch::set(bool stopped, std::string reason) {
  reason_ = std::move(reason);
  stopped_ = stopped;
  ever_set_ = true;
}

std::string StopSwitch::reason() const {
  const std::lock_guard lock(mutex_);
  return reason_;
}

void StopSwitch::tell(PeerLink& peer) const {
  bool stopped = false;
  std::string reason;
  {
    const std::lock_guard lock(mutex_);
    if (!ever_set_) return;
    stopped = stopped_;
    reason = reason_;
  }
  const auto& told = peer.stop_told();
  if (!told || told->stop != stopped || told->reason != reason) (void)peer.tell_stop(stopped, reason);
}

}  // namespace telehug
