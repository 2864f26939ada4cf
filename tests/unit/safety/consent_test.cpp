// SPDX-License-Identifier: Apache-2.0
#include "safety/consent.hpp"

#include <gmock/gmock.h>

#include <cstdlib>
#include <ctime>
#include <string>

namespace telehug {
namespace {

using std::chrono::sys_days;
using std::chrono::sys_seconds;
using namespace std::chrono_literals;

constexpr sys_seconds noon = sys_days{std::chrono::year{2026} / 6 / 1} + 12h;
constexpr int at(int hour, int minute = 0) {
  return hour * 60 + minute;
}

TEST(Consent, permits_everything_at_first) {
  EXPECT_EQ(permission_at({}, noon, at(12)), Permission{});
}

TEST(Consent, pauses_until_further_notice) {
  const Consent consent{
      .pause = Pause{}, .quiet_hours = {}, .own_quiet_hours = {}, .muted_boxes = {}, .muted_actuators = {}};
  EXPECT_EQ(permission_at(consent, noon, at(12)).refusal, FeltOutcome::paused);
  EXPECT_EQ(permission_at(consent, noon + 100000h, at(12)).refusal, FeltOutcome::paused);
}

TEST(Consent, pauses_until_a_time_and_no_second_longer) {
  Consent consent;
  consent.pause = Pause{noon + 30min};
  EXPECT_EQ(permission_at(consent, noon, at(12)).refusal, FeltOutcome::paused);
  EXPECT_EQ(permission_at(consent, noon + 30min - 1s, at(12)).refusal, FeltOutcome::paused);
  EXPECT_EQ(permission_at(consent, noon + 30min, at(12)).refusal, std::nullopt);
  EXPECT_EQ(permission_at(consent, noon - 10h, at(12)).refusal, FeltOutcome::paused) << "the clock was set back";
}

TEST(Consent, is_quiet_from_the_first_minute_of_a_span_to_the_last) {
  Consent consent;
  consent.quiet_hours = {{at(13), at(14, 30)}};
  EXPECT_EQ(permission_at(consent, noon, at(12, 59)).refusal, std::nullopt);
  EXPECT_EQ(permission_at(consent, noon, at(13)).refusal, FeltOutcome::quiet_hours);
  EXPECT_EQ(permission_at(consent, noon, at(14, 29)).refusal, FeltOutcome::quiet_hours);
  EXPECT_EQ(permission_at(consent, noon, at(14, 30)).refusal, std::nullopt);
}

TEST(Consent, is_quiet_across_midnight) {
  Consent consent;
  consent.quiet_hours = {{at(20, 30), at(7)}};
  for (int minute = 0; minute < minutes_of_day; ++minute) {
    const bool quiet = minute >= at(20, 30) || minute < at(7);
    EXPECT_EQ(permission_at(consent, noon, minute).refusal.has_value(), quiet) << minute;
  }
}

TEST(Consent, is_quiet_in_each_of_several_spans_and_knows_which_ends_last) {
  Consent consent;
  consent.quiet_hours = {{at(20), at(22)}, {at(13), at(14)}};
  consent.own_quiet_hours = {{at(21), at(6)}};
  EXPECT_EQ(quiet_span_at(consent, at(13, 30)), consent.quiet_hours[1]);
  EXPECT_EQ(quiet_span_at(consent, at(20, 30)), consent.quiet_hours[0]);
  EXPECT_EQ(quiet_span_at(consent, at(21, 30)), consent.own_quiet_hours[0]);
  EXPECT_EQ(quiet_span_at(consent, at(12)), std::nullopt);
}

TEST(Consent, tells_of_a_pause_before_quiet_hours) {
  Consent consent;
  consent.pause = Pause{noon + 1min};
  consent.quiet_hours = {{at(12), at(13)}};
  EXPECT_EQ(permission_at(consent, noon, at(12)).refusal, FeltOutcome::paused);
  EXPECT_EQ(permission_at(consent, noon + 1min, at(12, 1)).refusal, FeltOutcome::quiet_hours);
}

TEST(Consent, hands_on_what_is_muted) {
  Consent consent;
  consent.muted_boxes.set(8);
  consent.muted_actuators.set(3);
  const Permission permission = permission_at(consent, noon, at(12));
  EXPECT_TRUE(permission.muted_boxes.test(8));
  EXPECT_TRUE(permission.muted_actuators.test(3));
  EXPECT_EQ(permission.refusal, std::nullopt);
}

class LocalTime : public testing::Test {
 protected:
  void TearDown() override { in_zone(before_.c_str()); }
  static void in_zone(const char* zone) {
    setenv("TZ", zone, 1);
    tzset();
  }
  // 20:30 to 07:00 at this time in this zone.
  static bool quiet(sys_seconds time) {
    Consent consent;
    consent.quiet_hours = {{at(20, 30), at(7)}};
    return permission_at(consent, time, local_minute(time)).refusal == FeltOutcome::quiet_hours;
  }

 private:
  std::string before_ = std::getenv("TZ") == nullptr ? "UTC" : std::getenv("TZ");
};

// Central Europe, written out so that no list of zones needs to be installed: summer time from the last Sunday of
// March, 02:00, to the last Sunday of October, 03:00.
constexpr const char* berlin = "CET-1CEST,M3.5.0,M10.5.0/3";

TEST_F(LocalTime, knows_summer_time) {
  in_zone(berlin);
  EXPECT_EQ(local_minute(sys_days{std::chrono::year{2026} / 1 / 15} + 12h), at(13));
  EXPECT_EQ(local_minute(sys_days{std::chrono::year{2026} / 7 / 15} + 12h), at(14));
}

TEST_F(LocalTime, is_read_in_zones_with_half_hours_and_across_the_date_line) {
  in_zone("NST3:30");
  EXPECT_EQ(local_minute(noon), at(8, 30));
  in_zone("<+14>-14");
  EXPECT_EQ(local_minute(noon), at(2));
}

TEST_F(LocalTime, ends_a_quiet_night_at_seven_though_an_hour_was_skipped_or_came_twice) {
  in_zone(berlin);
  const sys_days spring{std::chrono::year{2026} / 3 / 29};  // the night has 9.5 hours
  EXPECT_FALSE(quiet(spring - 1h * 24 + 19h + 29min));      // CET: 20:29
  EXPECT_TRUE(quiet(spring - 1h * 24 + 19h + 30min));
  EXPECT_TRUE(quiet(spring + 4h + 59min));  // CEST: 06:59
  EXPECT_FALSE(quiet(spring + 5h));
  const sys_days autumn{std::chrono::year{2026} / 10 / 25};  // and here 11.5
  EXPECT_FALSE(quiet(autumn - 1h * 24 + 18h + 29min));
  EXPECT_TRUE(quiet(autumn - 1h * 24 + 18h + 30min));
  EXPECT_TRUE(quiet(autumn + 5h + 59min));
  EXPECT_FALSE(quiet(autumn + 6h));
}

TEST_F(LocalTime, is_quiet_in_both_hours_that_have_the_same_name) {
  in_zone(berlin);
  Consent consent;
  consent.quiet_hours = {{at(2, 15), at(2, 45)}};
  const sys_days autumn{std::chrono::year{2026} / 10 / 25};
  for (const auto time : {0h + 30min, 1h + 30min})
    EXPECT_TRUE(permission_at(consent, autumn + time, local_minute(autumn + time)).refusal);
  EXPECT_FALSE(permission_at(consent, autumn + 1h, local_minute(autumn + 1h)).refusal) << "02:00 again";
}

}  // namespace
}  // namespace telehug
