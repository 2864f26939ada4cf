// SPDX-License-Identifier: Apache-2.0
#include "config/reload.hpp"

#include <gmock/gmock.h>

namespace telehug {
namespace {

using testing::HasSubstr;

TEST(AConfigurationReadAnew, ChangesLiveKeysAndNamesThoseThatNeedARestart) {
  ActiveConfig used;
  ActiveConfig read;
  read.touch.up_after_ms = 90;
  read.hug.notify = false;
  read.camera.fps = 15;
  const auto next = reloaded(used, read, {"touch.up_after_ms", "hug."});
  ASSERT_TRUE(next);
  EXPECT_EQ(next->config.touch.up_after_ms, 90);
  EXPECT_FALSE(next->config.hug.notify);
  EXPECT_EQ(next->config.camera.fps, used.camera.fps);
  std::vector<std::string> said;
  for (const KeyChange& change : next->changes)
    said.push_back(change.path + " " + change.before + " " + change.after + (change.now ? " now" : " later"));
  EXPECT_THAT(said, testing::UnorderedElementsAre("camera.fps 30 15 later", "touch.up_after_ms 70 90 now",
                                                  "hug.notify true false now"));
}

TEST(AConfigurationReadAnew, ChangesNoLimitOfTheJacketWhileItRuns) {
  PassiveConfig used;
  used.safety.max_strength = 0.4;
  used.safety.max_celsius = 36;
  const auto next = reloaded(used, PassiveConfig{}, {"log.level"});
  ASSERT_TRUE(next);
  EXPECT_EQ(next->config.safety.max_strength, 0.4);
  EXPECT_EQ(next->config.safety.max_celsius, 36);
  ASSERT_EQ(next->changes.size(), 2U);
  EXPECT_FALSE(next->changes[0].now || next->changes[1].now);
}

TEST(AConfigurationReadAnew, IsNotTakenIfWhatIsLiveDoesNotFitWhatIsNot) {
  const ActiveConfig used;
  ActiveConfig read;
  read.peer.loopback_only = true;
  read.peer.addresses = "10.0.0.1";
  const auto next = reloaded(used, read, {"peer."});
  ASSERT_FALSE(next);
  EXPECT_THAT(next.error().message, HasSubstr("peer.loopback_only"));
}

}  // namespace
}  // namespace telehug
