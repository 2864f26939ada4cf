// SPDX-License-Identifier: Apache-2.0
#include "gpio/emergency_stop.hpp"

#include <algorithm>
#include <utility>

namespace telehug {

EmergencyStop::EmergencyStop(const Settings& settings, bool active) noexcept
    : settings_(settings),
      contact_(settings.debounce, active),
      pressed_(active),
      orders_{.stop = active, .resume = false} {}

void EmergencyStop::level(bool active, Timestamp time) noexcept {
  follow(time);  // what settled before
  contact_.level(active, time);
  follow(time);
}

void EmergencyStop::lose() noexcept {
  if (lost_) return;
  lost_ = true;
  may_resume_ = false;
  orders_ = {.stop = true, .resume = false};
}

EmergencyStop::Orders EmergencyStop::orders(Timestamp now, bool stopped) noexcept {
  follow(now);
  stopped_ = stopped || orders_.stop;
  return std::exchange(orders_, {});
}

std::optional<Timestamp> EmergencyStop::due() const noexcept {
  auto due = contact_.due();
  if (due && !pressed_) due = std::min(*due, *contact_.restless_since() + longest_bounce);
  return due;
}

void EmergencyStop::follow(Timestamp now) noexcept {
  const auto restless = contact_.restless_since();
  now = contact_.advance(now);
  const bool bounces_on = contact_.restless_since() && now - *contact_.restless_since() >= longest_bounce;
  const bool active = contact_.active() || bounces_on;
  if (lost_ || active == pressed_) return;
  pressed_ = active;
  if (pressed_) {
    may_resume_ = stopped_ && settings_.hold_to_resume > Duration::zero();
    pressed_since_ = restless.value_or(now);
    orders_ = {.stop = true, .resume = false};
    return;
  }
  const Duration held = restless.value_or(now) - pressed_since_;
  if (may_resume_ && held >= settings_.hold_to_resume && held <= settings_.hold_to_resume + to_let_go)
    orders_.resume = true;
}

}  // namespace telehug
