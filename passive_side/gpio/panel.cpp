// SPDX-License-Identifier: Apache-2.0
#include "gpio/panel.hpp"

#include <poll.h>

#include <algorithm>
#include <array>
#include <ctime>
#include <utility>

namespace telehug {
namespace {

constexpr const char* button_reason = "the emergency stop button was pressed";
constexpr const char* button_obstacle = "the emergency stop button is pressed, or its cable is broken: let go of it";
constexpr const char* lost_reason = "the emergency stop button is lost";
constexpr const char* lost_obstacle = "the emergency stop button is lost: mend it and start telehug-passive again";

enum Bit : std::uint8_t { armed_bit = 1, stopped_bit = 2, sender_bit = 4, touched_bit = 8 };

std::uint8_t bits_of(const JacketSituation& now) noexcept {
  return static_cast<std::uint8_t>((now.armed ? armed_bit : 0) | (now.stopped ? stopped_bit : 0) |
                                   (now.sender ? sender_bit : 0) | (now.touched ? touched_bit : 0));
}

}  // namespace

Panel::Panel(PanelLines lines, const PanelOptions& options, PanelCalls calls, const Clock& clock)
    : lines_(std::move(lines)), calls_(std::move(calls)), clock_(clock) {
  status_.problems = lines_.missing;
  status_.stop_button = lines_.stop_button != nullptr;
  status_.power_line = lines_.power != nullptr;
  if (!lines_.stop_button) return;
  const auto level = lines_.stop_button->level();
  emergency_stop_.emplace(
      EmergencyStop::Settings{.debounce = options.debounce, .hold_to_resume = options.hold_to_resume}, level && *level);
  if (!level) lose_stop_button(level.error());
}

Panel::~Panel() {
  stop();
}

void Panel::start() {
  serve(clock_.now());
  if (lines_.stop_button || lines_.hug_button || lines_.power || lines_.light) thread_ = std::thread([this] { run(); });
}

void Panel::stop() {
  ending_ = true;
  if (thread_.joinable()) thread_.join();
  lines_.power.reset();
  lines_.light.reset();
}

void Panel::tell(const JacketSituation& situation, Timestamp now) noexcept {
  told_ = bits_of(situation);
  told_ns_ = to_ns(now);
}

PanelStatus Panel::status() const {
  const std::lock_guard lock(mutex_);
  return status_;
}

void Panel::run() {
  while (!ending_) {
    wait(clock_.now());
    serve(clock_.now());
  }
}

// Until a button moves, something is due, or the round is over.
void Panel::wait(Timestamp now) {
  Timestamp until = now + round;
  const auto no_later_than = [&](const std::optional<Timestamp>& due) {
    if (due) until = std::clamp(*due, now, until);
  };
  if (emergency_stop_) no_later_than(emergency_stop_->due());
  if (lines_.hug_button) no_later_than(lines_.hug_button->due());
  std::array<pollfd, 2> watched{};
  watched[0] = {lines_.stop_button ? lines_.stop_button->fd() : -1, POLLIN, 0};
  watched[1] = {lines_.hug_button ? lines_.hug_button->fd() : -1, POLLIN, 0};
  const std::int64_t left_ns = to_ns(until) - to_ns(now);
  const timespec left{0, left_ns};
  (void)ppoll(watched.data(), watched.size(), &left, nullptr);
}

void Panel::serve(Timestamp now) {
  serve_stop_button(now);
  serve_hug_button(now);
  serve_outputs(now);
}

void Panel::serve_stop_button(Timestamp now) {
  if (!emergency_stop_) return;
  if (lines_.stop_button) {
    auto change = lines_.stop_button->next(now);
    // Bounded: a line that never ends to change must not keep the others waiting.
    for (int changes = 0; change && *change && changes < 64; ++changes) {
      emergency_stop_->level((*change)->active, std::min((*change)->time, now));
      change = lines_.stop_button->next(now);
    }
    // Whatever changes were lost, this is how it stands.
    auto level = change ? lines_.stop_button->level() : Result<bool>(change.error());
    if (level) {
      emergency_stop_->level(*level, now);
    } else {
      lose_stop_button(level.error());
    }
  }
  const auto orders = emergency_stop_->orders(now, calls_.stopped());
  if (orders.stop) {
    held_ = true;
    if (emergency_stop_->lost()) {
      calls_.hold(lost_reason, lost_obstacle);
    } else {
      calls_.hold(button_reason, button_obstacle);
    }
  }
  if (held_ && !emergency_stop_->pressed() && !power_lost_) {
    held_ = false;
    calls_.release();
  }
  if (orders.resume) calls_.resume();
  const std::lock_guard lock(mutex_);
  status_.stop_pressed = emergency_stop_->pressed();
}

void Panel::serve_hug_button(Timestamp now) {
  if (!lines_.hug_button) return;
  auto change = lines_.hug_button->next(now);
  for (int changes = 0; change && *change && changes < 64; ++changes) {
    if ((*change)->active) calls_.hug();
    change = lines_.hug_button->next(now);
  }
  const auto level = change ? lines_.hug_button->level() : Result<bool>(change.error());
  if (level) return;
  lines_.hug_button.reset();
  note("the hug button", level.error());
}

void Panel::serve_outputs(Timestamp now) {
  const JacketSituation is = situation(now);
  if (lines_.power) {
    const bool wanted = supply_wanted(is);
    const auto set = wanted == power_ ? Status(Done{}) : lines_.power->set(wanted);
    if (!set) {
      lose_power(set.error());
    } else if (wanted != power_) {
      power_ = wanted;
      const std::lock_guard lock(mutex_);
      status_.power = wanted;
    }
  }
  if (lines_.light) {
    const bool wanted = light_on(light_pattern(is), std::chrono::nanoseconds(to_ns(now)));
    const auto set = wanted == light_ ? Status(Done{}) : lines_.light->set(wanted);
    light_ = wanted;
    if (set) return;
    lines_.light.reset();
    note("the status light", set.error());
  }
}

JacketSituation Panel::situation(Timestamp now) const {
  JacketSituation is;
  if (to_ns(now) - told_ns_ < std::chrono::nanoseconds(oldest_situation).count()) {
    const std::uint8_t bits = told_;
    is.armed = (bits & armed_bit) != 0;
    is.stopped = (bits & stopped_bit) != 0;
    is.sender = (bits & sender_bit) != 0;
    is.touched = (bits & touched_bit) != 0;
  }
  // Not only once the drive thread has followed.
  is.stopped = is.stopped || calls_.stopped();
  is.problem = power_lost_ || (emergency_stop_ && emergency_stop_->lost());
  return is;
}

void Panel::lose_stop_button(const Error& why) {
  emergency_stop_->lose();
  lines_.stop_button.reset();
  note("the emergency stop button", why);
}

void Panel::lose_power(const Error& why) {
  power_lost_ = true;
  held_ = true;
  lines_.power.reset();
  note("the power line", why);
  calls_.hold("the power line is lost", "the power line is lost: mend it and start telehug-passive again");
}

void Panel::note(const char* what, const Error& why) {
  const std::lock_guard lock(mutex_);
  status_.problems.push_back(std::string(what) + " does not work: " + why.message);
}

}  // namespace telehug
