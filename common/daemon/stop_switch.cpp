// SPDX-License-Identifier: Apache-2.0
#include "daemon/stop_switch.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "daemon/kept_stop.hpp"
#include "daemon/status_parts.hpp"
#include "service/log.hpp"

namespace telehug {
namespace {

constexpr std::size_t longest_reason = 200;  // bytes
constexpr Duration retry_interval = 10s;

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

nlohmann::json not_kept(bool stopped, const std::string& why) {
  if (stopped) {
    return problem_json("the stop will not outlive a restart: " + why,
                        "mend that, it is tried again by itself; until then say `telehug stop` again after a restart");
  }
  return problem_json("everything will be stopped again after a restart: " + why,
                      "mend that, it is tried again by itself");
}

}  // namespace

StopSwitch::StopSwitch(std::filesystem::path file) : file_(std::move(file)) {
  const auto kept = read_kept_stop(file_);
  if (kept && !*kept) return;
  if (!kept) {
    const std::string what = fmt::format("{} {}", file_.string(), kept.error().message);
    problem_ = problem_json("whether everything was stopped is not known: " + what, "`telehug resume` begins anew");
    log_about({.stage = "stop"}, spdlog::level::err, problem_.at("what").get<std::string>());
  }
  set(true, kept ? one_line(**kept) : "nobody knows whether it was stopped before the restart");
  tried_ = kept_ = changes_;
  say_stopped(reason_);
}

void StopSwitch::serve(ControlServer& control) {
  control.on("stop", [this](const nlohmann::json& request) {
    auto answer = stop(request);
    write();
    return answer;
  });
  control.on("resume", [this](const nlohmann::json&) {
    auto answer = resume();
    write();
    return answer;
  });
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

void StopSwitch::hold(const std::string& reason, std::string obstacle) {
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
  ++changes_;
}

void StopSwitch::keep(Timestamp now) {
  {
    const std::lock_guard lock(mutex_);
    const bool waits = tried_ == changes_ && tried_at_ && now - *tried_at_ < retry_interval;
    if (kept_ == changes_ || waits) return;
  }
  tried_at_ = now;
  write();
}

void StopSwitch::write() {
  const std::lock_guard writing(writing_);
  std::optional<std::string> reason;
  std::uint64_t change = 0;
  {
    const std::lock_guard lock(mutex_);
    if (kept_ == changes_) return;
    if (stopped_) reason = reason_;
    change = changes_;
  }
  const Status kept = keep_stop(file_, reason);
  nlohmann::json problem;
  if (!kept) {
    problem = not_kept(reason.has_value(), kept.error().message);
    say_.say(spdlog::level::err, problem.at("what").get<std::string>(), {.stage = "stop"});
  } else {
    say_.forget();
  }
  const std::lock_guard lock(mutex_);
  problem_ = std::move(problem);
  tried_ = change;
  if (kept) kept_ = change;
}

nlohmann::json StopSwitch::problem() const {
  const std::lock_guard lock(mutex_);
  return problem_;
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
    if (changes_ == 0) return;
    stopped = stopped_;
    reason = reason_;
  }
  const auto& told = peer.stop_told();
  if (!told || told->stop != stopped || told->reason != reason) (void)peer.tell_stop(stopped, reason);
}

}  // namespace telehug
