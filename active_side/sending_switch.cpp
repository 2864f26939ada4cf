// SPDX-License-Identifier: Apache-2.0
#include "sending_switch.hpp"

#include <fmt/core.h>

#include "service/log.hpp"

namespace telehug {
namespace {

std::optional<SendingMode> mode_named(const std::string& name) {
  if (name == "auto") return SendingMode::automatic;
  if (name == "on") return SendingMode::on;
  if (name == "off") return SendingMode::off;
  return std::nullopt;
}

}  // namespace

const char* name_of(SendingMode mode) {
  switch (mode) {
    case SendingMode::automatic:
      return "auto";
    case SendingMode::on:
      return "on";
    case SendingMode::off:
      return "off";
  }
  return "";
}

SendingVerdict judge_sending(SendingMode mode, bool only_in_front, bool used_here, const ScreenView& screen) {
  if (mode == SendingMode::off) return SendingVerdict::switched_off;
  if (used_here) return SendingVerdict::used_here;
  if (screen.pins_window && !screen.in_front) return SendingVerdict::not_seen;
  if (screen.in_front) return *screen.in_front || !only_in_front ? SendingVerdict::sends : SendingVerdict::covered;
  return mode == SendingMode::on || !screen.live ? SendingVerdict::sends : SendingVerdict::never_pinned;
}

SendingSwitch::SendingSwitch(const std::string& at_start, bool only_in_front)
    : mode_(mode_named(at_start).value_or(SendingMode::off)), only_in_front_(only_in_front) {}

void SendingSwitch::serve(ControlServer& control) {
  control.on("send", [this](const nlohmann::json& request) { return set(request); });
}

void SendingSwitch::toggle() {
  set(mode_ == SendingMode::off ? before_off_.load() : SendingMode::off);
}

void SendingSwitch::set(SendingMode mode) {
  const SendingMode before = mode_.exchange(mode);
  if (mode == SendingMode::off && before != SendingMode::off) before_off_ = before;
  log_about({.stage = "sending"}, spdlog::level::info, fmt::format("sending touches: {}", name_of(mode)));
}

nlohmann::json SendingSwitch::set(const nlohmann::json& request) {
  const auto wanted = request.find("mode");
  const std::string name = wanted != request.end() && wanted->is_string() ? wanted->get<std::string>() : "";
  if (name == "toggle") {
    toggle();
  } else if (const auto mode = mode_named(name)) {
    set(*mode);
  } else {
    return {{"error", "\"mode\" is one of on, off, auto, toggle"}};
  }
  return {{"sending", name_of(mode_)}};
}

}  // namespace telehug
