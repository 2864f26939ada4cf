// SPDX-License-Identifier: Apache-2.0
#include "heater_watch.hpp"

#include "reading_rate.hpp"

using telehug::protocol::HeaterFault;

namespace {

// A heater of 2 W on 8 J/K warms by 0.25 C a second at most. README.md says how these limits follow.
constexpr int16_t rise_seen = 5;
constexpr int16_t clearly_below = 20;
constexpr uint16_t no_rise_readings = readings_in_ms(15000);
constexpr uint16_t no_rise_near_readings = readings_in_ms(25000);
constexpr int16_t fall_seen = 10;
constexpr uint16_t fall_readings = readings_in_ms(3000);

constexpr int16_t fast_rise = 30;
constexpr uint16_t window_readings = readings_in_ms(2000);

static_assert(window_readings <= 255, "counted in one byte");

}  // namespace

HeaterFault HeaterWatch::judge(int16_t temperature, int16_t set_point, bool heated) {
  if (!begun_) {
    begun_ = true;
    risen_to_ = temperature;
    window_start_ = temperature;
  }
  if (rises_too_fast(temperature, heated)) return HeaterFault::rises_too_fast;
  if (does_not_rise(temperature, set_point, heated)) return HeaterFault::no_rise;
  return HeaterFault::none;
}

bool HeaterWatch::rises_too_fast(int16_t temperature, bool heated) {
  heated_in_window_ |= heated;
  if (heated_in_window_ && temperature >= window_start_ + fast_rise) return true;
  if (++readings_in_window_ >= window_readings) {
    readings_in_window_ = 0;
    window_start_ = temperature;
    heated_in_window_ = heated;
  }
  return false;
}

bool HeaterWatch::does_not_rise(int16_t temperature, int16_t set_point, bool heated) {
  if (readings_heated_ == 0 || set_point > goal_) goal_ = set_point;
  if (temperature >= goal_) readings_heated_ = 0;
  if (heated) {
    ++readings_heated_;
  } else {
    readings_heated_ = readings_heated_ > 2 ? readings_heated_ - 2 : 0;
  }
  if (readings_heated_ == 0 || temperature >= risen_to_ + rise_seen) {
    readings_heated_ = 0;
    risen_to_ = temperature;
  }
  if (!heated) return false;
  if (temperature <= risen_to_ - fall_seen && readings_heated_ >= fall_readings) return true;
  const bool clear = temperature <= set_point - clearly_below;
  return readings_heated_ >= (clear ? no_rise_readings : no_rise_near_readings);
}
