// SPDX-License-Identifier: Apache-2.0
//
// The lines of the jacket: what its buttons do, and what its panel is told.
#include <algorithm>

#include "daemon/status_parts.hpp"
#include "passive_daemon.hpp"

namespace telehug {

namespace {

PanelOptions panel_options(const GpioConfig& config) {
  const Pull pull = config.button_pull == "up" ? Pull::up : config.button_pull == "down" ? Pull::down : Pull::none;
  return {.chip = config.chip,
          .stop_button = {config.stop_button_line, config.stop_button_active_low},
          .hug_button = {config.hug_button_line, config.hug_button_active_low},
          .power = {config.power_line, config.power_active_low},
          .light = {config.led_line, config.led_active_low},
          .button_pull = pull,
          .debounce = std::chrono::milliseconds(config.debounce_ms),
          .hold_to_resume = std::chrono::seconds(config.stop_button_resume_s)};
}

}  // namespace

std::unique_ptr<Panel> PassiveDaemon::make_panel() {
  const PanelOptions options = panel_options(config_.gpio);
  auto lines = request_lines(options);
  if (!lines) throw LineMissing(lines.error().message);
  PanelCalls calls{.hold =
                       [this](const std::string& reason, const std::string& obstacle) {
                         stop_.hold(reason, obstacle);
                         bell_.put(true);  // the drive thread need not finish its pause
                       },
                   .release = [this] { stop_.release(); },
                   .resume = [this] { stop_.resume(); },
                   .stopped = [this] { return stop_.stopped(); },
                   .hug = [this] { hug_pressed_ = true; }};
  return std::make_unique<Panel>(*std::move(lines), options, std::move(calls), clock_);
}

void PassiveDaemon::tell_panel(Timestamp now) {
  const auto& senders = senders_.adopted();
  JacketSituation situation;
  situation.armed = safety_.link_status().state == LinkState::armed;
  situation.stopped = safety_.stopped();
  situation.sender = std::ranges::any_of(senders, [now](const auto& sender) { return sender->connection.alive(now); });
  situation.touched = !told_running_.empty();
  panel_->tell(situation, now);
}

void PassiveDaemon::answer_hug_button() {
  if (!hug_pressed_.exchange(false)) return;
  const auto answer = order_hug({{"command", "hug"}});
  if (const auto refused = answer.find("error"); refused != answer.end())
    log_about({.stage = "hug"}, spdlog::level::info, "the hug button was pressed, but " + refused->get<std::string>());
}

void PassiveDaemon::add_panel(nlohmann::json& status) const {
  const PanelStatus panel = panel_->status();
  if (panel.stop_button) status["panel"]["stop_button"] = panel.stop_pressed ? "pressed" : "released";
  if (panel.power_line) status["panel"]["power"] = panel.power;
  for (const std::string& problem : panel.problems)
    status["problems"].push_back(problem_json(problem, "mend it, then start telehug-passive again"));
}

}  // namespace telehug
