// SPDX-License-Identifier: Apache-2.0
#include "consent_switch.hpp"

#include <gmock/gmock.h>

#include <fstream>

#include "config/quiet_hours_text.hpp"
#include "consent_file.hpp"
#include "doubles/temporary_folder.hpp"
#include "unit/jacket/jacket_builders.hpp"

namespace telehug {
namespace {

using testing::HasSubstr;
using Json = nlohmann::json;
using std::chrono::sys_days;
using std::chrono::sys_seconds;

constexpr sys_seconds noon = sys_days{std::chrono::year{2026} / 6 / 1} + 12h;

class TheConsentSwitch : public testing::Test {
 protected:
  TheConsentSwitch() {
    setenv("TZ", "UTC0", 1);
    tzset();
  }
  [[nodiscard]] std::optional<FeltOutcome> refusal(const ConsentSwitch& its, sys_seconds now = noon) const {
    return permission_at(its.consent(), now, local_minute(now)).refusal;
  }

  TemporaryFolder folder;
  std::filesystem::path file = folder / "consent.json";
  JacketProfile profile = profile_of({motor(1, {}, {1}), motor(2, {}, {2})});
  ConsentSwitch consent{file, {}, profile};
};

TEST_F(TheConsentSwitch, pauses_until_further_notice_or_for_some_minutes) {
  EXPECT_EQ(consent.pause(Json::object(), noon), Json({{"side", "passive"}, {"paused", true}}));
  EXPECT_EQ(refusal(consent, noon + 1000h), FeltOutcome::paused);
  EXPECT_EQ(consent.pause({{"minutes", 90}}, noon), Json({{"side", "passive"}, {"paused", true}, {"until", "13:30"}}));
  EXPECT_EQ(refusal(consent, noon + 89min), FeltOutcome::paused);
  EXPECT_EQ(refusal(consent, noon + 90min), std::nullopt);
  consent.pause(Json::object(), noon);
  EXPECT_EQ(consent.unpause(), Json({{"side", "passive"}, {"paused", false}}));
  EXPECT_EQ(refusal(consent), std::nullopt);
}

TEST_F(TheConsentSwitch, follows_quiet_hours_that_the_configuration_changes_and_keeps_the_wearers_own) {
  consent.quiet({{"hours", "20:00-21:00"}});
  (void)consent.take();
  consent.set_configured_quiet_hours(parse_quiet_hours("11:00-13:00").value());
  EXPECT_EQ(refusal(consent), FeltOutcome::quiet_hours);
  const auto told = consent.take();
  ASSERT_TRUE(told);
  EXPECT_EQ(quiet_hours_text(told->quiet_hours), "11:00-13:00");
  EXPECT_EQ(quiet_hours_text(told->own_quiet_hours), "20:00-21:00");
  consent.pause(Json::object(), noon);
  EXPECT_EQ(quiet_hours_text(consent.take()->quiet_hours), "11:00-13:00");
  consent.set_configured_quiet_hours({});
  EXPECT_EQ(refusal(consent), FeltOutcome::paused) << "the wearer's pause is not ended by a configuration";
}

TEST_F(TheConsentSwitch, lowers_the_strength_and_keeps_it) {
  EXPECT_EQ(consent.strength({{"strength", 0.25}}), Json({{"side", "passive"}, {"strength", 0.25}}));
  EXPECT_EQ(consent.take()->strength, 0.25);
  EXPECT_EQ(permission_at(consent.consent(), noon, 0).strength, 0.25);
  EXPECT_EQ(consent_json(consent.consent(), noon).at("strength"), 0.25);
  EXPECT_EQ(ConsentSwitch(file, {}, profile).consent().strength, 0.25);
  consent.strength({{"strength", 1}});
  EXPECT_FALSE(consent_json(consent.consent(), noon).contains("strength"));
}

TEST_F(TheConsentSwitch, takes_no_strength_beyond_the_limits_or_none_at_all) {
  for (const Json& strength : {Json(0), Json(-0.1), Json(1.01), Json("1"), Json(nullptr), Json(true), Json::array({1})})
    EXPECT_TRUE(consent.strength({{"strength", strength}}).contains("error")) << strength;
  EXPECT_TRUE(consent.strength(Json::object()).contains("error"));
  EXPECT_EQ(consent.consent(), Consent{});
  EXPECT_FALSE(std::filesystem::exists(file));
}

TEST_F(TheConsentSwitch, adds_the_wearers_quiet_hours_to_those_of_the_configuration) {
  ConsentSwitch quiet(file, {{11 * 60, 12 * 60 + 30}}, profile);
  EXPECT_EQ(quiet.quiet({{"hours", "12:15-13:00"}}), Json({{"side", "passive"}, {"own_quiet_hours", "12:15-13:00"}}));
  EXPECT_EQ(refusal(quiet, noon), FeltOutcome::quiet_hours);
  EXPECT_EQ(refusal(quiet, noon + 59min), FeltOutcome::quiet_hours);
  EXPECT_EQ(refusal(quiet, noon + 60min), std::nullopt);
  EXPECT_EQ(refusal_text(quiet.consent(), noon + 20min), "quiet hours until 13:00") << "the one that ends last";
  EXPECT_EQ(consent_json(quiet.consent(), noon).at("own_quiet_hours"), "12:15-13:00");
  EXPECT_EQ(consent_json(quiet.consent(), noon).at("quiet_hours"), "11:00-12:30");
  EXPECT_EQ(ConsentSwitch(file, {}, profile).consent().own_quiet_hours, quiet.consent().own_quiet_hours);
  EXPECT_EQ(quiet.quiet({{"hours", ""}}).at("own_quiet_hours"), "");
  EXPECT_EQ(refusal(quiet, noon), FeltOutcome::quiet_hours) << "the configuration's are not the wearer's to take away";
  EXPECT_EQ(refusal(quiet, noon + 40min), std::nullopt);
}

TEST_F(TheConsentSwitch, takes_no_quiet_hours_that_are_none) {
  for (const Json& hours :
       {Json("20:30"), Json("25:00-26:00"), Json("10:00-10:00"), Json(20), Json(nullptr), Json::array()})
    EXPECT_TRUE(consent.quiet({{"hours", hours}}).contains("error")) << hours;
  EXPECT_TRUE(consent.quiet(Json::object()).contains("error"));
  EXPECT_EQ(consent.consent(), Consent{});
  EXPECT_FALSE(std::filesystem::exists(file));
}

TEST_F(TheConsentSwitch, tells_until_when_nothing_is_felt_if_it_is_known) {
  consent.pause({{"minutes", 90}}, noon);
  EXPECT_EQ(consent_json(consent.consent(), noon).at("until"), "13:30");
  consent.pause(Json::object(), noon);
  EXPECT_FALSE(consent_json(consent.consent(), noon).contains("until"));
}

TEST_F(TheConsentSwitch, changes_nothing_for_a_request_that_is_none) {
  for (const Json& minutes : {Json(0), Json(-1), Json(1441), Json(1.5), Json("5"), Json(nullptr), Json::array({1})})
    EXPECT_TRUE(consent.pause({{"minutes", minutes}}, noon).contains("error")) << minutes;
  for (const Json& request :
       {Json::object(), Json{{"boxes", Json::array()}}, Json{{"boxes", 8}}, Json{{"boxes", {0}}},
        Json{{"boxes", {101}}}, Json{{"boxes", {"8"}}}, Json{{"boxes", Json::object()}}, Json{{"actuators", {256}}},
        Json{{"actuators", {-1}}}, Json{{"boxes", {8}}, {"actuators", {3}}}, Json{{"all", true}}}) {
    EXPECT_TRUE(consent.mute(request, true).contains("error")) << request;
  }
  EXPECT_EQ(consent.consent(), Consent{});
  EXPECT_FALSE(std::filesystem::exists(file));
  EXPECT_EQ(consent.take(), std::nullopt);
}

TEST_F(TheConsentSwitch, mutes_and_unmutes_boxes_and_actuators) {
  EXPECT_EQ(consent.mute({{"boxes", {8, 13}}, {"actuators", {2}}}, true),
            Json({{"side", "passive"}, {"muted_boxes", {8, 13}}, {"muted_actuators", {2}}}));
  EXPECT_EQ(consent.mute({{"boxes", {13}}}, false),
            Json({{"side", "passive"}, {"muted_boxes", {8}}, {"muted_actuators", {2}}}));
  EXPECT_EQ(consent.mute({{"all", true}}, false),
            Json({{"side", "passive"}, {"muted_boxes", Json::array()}, {"muted_actuators", Json::array()}}));
}

TEST_F(TheConsentSwitch, knows_no_actuator_that_the_jacket_lacks_but_forgets_one) {
  EXPECT_THAT(consent.mute({{"actuators", {7}}}, true).value("error", ""), HasSubstr("has no actuator 7"));
  EXPECT_FALSE(consent.mute({{"actuators", {7}}}, false).contains("error"));
}

TEST_F(TheConsentSwitch, hands_every_change_to_the_drive_thread_once) {
  EXPECT_EQ(consent.take(), std::nullopt);
  consent.mute({{"boxes", {8}}}, true);
  consent.pause(Json::object(), noon);
  const auto taken = consent.take();
  ASSERT_TRUE(taken);
  EXPECT_EQ(*taken, consent.consent());
  EXPECT_EQ(consent.take(), std::nullopt);
}

TEST_F(TheConsentSwitch, is_as_it_was_after_a_restart_but_for_the_quiet_hours) {
  consent.pause({{"minutes", 90}}, noon);
  consent.mute({{"boxes", {8}}}, true);
  const ConsentSwitch again(file, {{0, 60}}, profile);
  Consent expected = consent.consent();
  expected.quiet_hours = {{0, 60}};
  EXPECT_EQ(again.consent(), expected);
  EXPECT_TRUE(again.problem().is_null());
}

TEST_F(TheConsentSwitch, is_paused_if_the_file_is_damaged_until_that_is_ended) {
  std::ofstream(file) << "{";
  ConsentSwitch damaged(file, {}, profile);
  EXPECT_EQ(refusal(damaged), FeltOutcome::paused);
  EXPECT_THAT(damaged.problem().at("what").get<std::string>(), HasSubstr(file.string() + " is damaged"));
  EXPECT_THAT(damaged.problem().at("do").get<std::string>(), HasSubstr("telehug unpause"));
  damaged.unpause();
  EXPECT_EQ(refusal(damaged), std::nullopt);
  EXPECT_TRUE(damaged.problem().is_null());
  EXPECT_EQ(read_consent(file).value(), Consent{});
}

TEST_F(TheConsentSwitch, stays_paused_when_something_is_muted_while_the_file_is_damaged) {
  std::ofstream(file) << "{";
  ConsentSwitch damaged(file, {}, profile);
  damaged.mute({{"boxes", {8}}}, true);
  EXPECT_EQ(refusal(damaged), FeltOutcome::paused);
  EXPECT_EQ(refusal(ConsentSwitch(file, {}, profile)), FeltOutcome::paused);
}

TEST_F(TheConsentSwitch, pauses_though_that_can_not_be_kept_and_says_so) {
  const std::filesystem::path nowhere = folder / "consent.json" / "below-a-file";
  std::ofstream(file) << "in the way";
  ConsentSwitch unkept(nowhere, {}, profile);
  unkept.unpause();
  EXPECT_THAT(unkept.pause(Json::object(), noon).value("error", ""), HasSubstr("it is so now, but not after"));
  EXPECT_EQ(refusal(unkept), FeltOutcome::paused);
  EXPECT_TRUE(unkept.take());
  EXPECT_THAT(unkept.problem().at("what").get<std::string>(), HasSubstr("is forgotten at the next start"));
}

TEST_F(TheConsentSwitch, says_why_nothing_is_felt_and_until_when) {
  Consent wanted;
  EXPECT_EQ(refusal_text(wanted, noon), "");
  EXPECT_EQ(consent_json(wanted, noon), Json({{"name", "open"}}));
  wanted.quiet_hours = {{11 * 60, 14 * 60 + 5}};
  EXPECT_EQ(refusal_text(wanted, noon), "quiet hours until 14:05");
  wanted.pause = Pause{noon + 30min};
  EXPECT_EQ(refusal_text(wanted, noon), "paused until 12:30");
  wanted.pause = Pause{};
  wanted.muted_boxes.set(8);
  wanted.muted_actuators.set(2);
  EXPECT_EQ(consent_json(wanted, noon), Json({{"name", "paused"},
                                              {"why", "until further notice"},
                                              {"quiet_hours", "11:00-14:05"},
                                              {"muted_boxes", {8}},
                                              {"muted_actuators", {2}}}));
}

}  // namespace
}  // namespace telehug
