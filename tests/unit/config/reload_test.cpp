// SPDX-License-Identifier: Apache-2.0
#include "config/reload.hpp"

#include <gmock/gmock.h>

#include <algorithm>

#include "config/key.hpp"

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
  const auto next = reloaded(used, PassiveConfig{});
  ASSERT_TRUE(next);
  EXPECT_EQ(next->config.safety.max_strength, 0.4);
  EXPECT_EQ(next->config.safety.max_celsius, 36);
  ASSERT_EQ(next->changes.size(), 2U);
  EXPECT_FALSE(next->changes[0].now || next->changes[1].now);
}

TEST(AConfigurationReadAnew, ChangesOfTheWearersSideTheQuietHoursAndTheLogAlone) {
  PassiveConfig config;
  std::vector<std::string> live;
  for (const Key& key : keys_of(config))
    if (is_live(key.path(), live_keys(Side::passive))) live.push_back(key.path());
  EXPECT_THAT(live, testing::UnorderedElementsAre("consent.quiet_hours", "log.level"));
}

TEST(AConfigurationReadAnew, KnowsLiveKeysByTheirNamesAndSections) {
  const LiveKeys live{"touch.", "log.level"};
  EXPECT_TRUE(is_live("touch.up_after_ms", live));
  EXPECT_TRUE(is_live("log.level", live));
  for (const char* other : {"log.levels", "log.", "local_touch.uinput", "touch", "a.touch.b"})
    EXPECT_FALSE(is_live(other, live)) << other;
}

// A key that no longer exists would promise a reload that does nothing.
TEST(AConfigurationReadAnew, HasLiveKeysThatExist) {
  const auto holds = [](Side side, const std::vector<Key>& keys) {
    for (const std::string_view live : live_keys(side))
      EXPECT_TRUE(std::ranges::any_of(keys, [&](const Key& key) { return is_live(key.path(), {live}); })) << live;
  };
  ActiveConfig active;
  PassiveConfig passive;
  holds(Side::active, keys_of(active));
  holds(Side::passive, keys_of(passive));
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
