// SPDX-License-Identifier: Apache-2.0
#include "service/log.hpp"

#include <gmock/gmock.h>

namespace telehug {
namespace {

using testing::internal::CaptureStderr;
using testing::internal::GetCapturedStderr;

TEST(Log, CarriesThePriorityForTheJournal) {
  CaptureStderr();
  set_up_log("info", LogStyle::journal);
  spdlog::error("no camera");
  spdlog::warn("late");
  spdlog::info("started");
  spdlog::debug("unseen");
  EXPECT_EQ(GetCapturedStderr(), "<3>no camera\n<4>late\n<6>started\n");
}

TEST(Log, CarriesTheTimeElsewhere) {
  CaptureStderr();
  set_up_log("debug", LogStyle::plain);
  spdlog::debug("seen");
  EXPECT_THAT(GetCapturedStderr(), testing::MatchesRegex("[0-9-]+T[0-9:.]+[+-][0-9:]+ debug   seen\n"));
}

TEST(Log, TakesAnUnknownLevelForInfo) {
  set_up_log("shouting", LogStyle::plain);
  EXPECT_EQ(spdlog::get_level(), spdlog::level::info);
}

TEST(SayOnChange, LogsAStateOnceUntilItChanges) {
  CaptureStderr();
  set_up_log("info", LogStyle::journal);
  SayOnChange camera;
  camera.say(spdlog::level::warn, "no camera");
  camera.say(spdlog::level::warn, "no camera");
  camera.say(spdlog::level::info, "camera {} back");
  camera.forget();
  camera.say(spdlog::level::info, "camera {} back");
  EXPECT_EQ(GetCapturedStderr(), "<4>no camera\n<6>camera {} back\n<6>camera {} back\n");
}

}  // namespace
}  // namespace telehug
