// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

#include "jacket/jacket_overrides.hpp"
#include "jacket/load_jacket_profile.hpp"

namespace telehug {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

class JacketOverridesTest : public ::testing::Test {
 protected:
  JacketOverridesTest() {
    std::string pattern = ::testing::TempDir() + "telehug-overrides-XXXXXX";
    folder_ = mkdtemp(pattern.data());
  }
  ~JacketOverridesTest() override { std::filesystem::remove_all(folder_); }

  [[nodiscard]] Result<JacketProfile> with(const std::string& text) const {
    std::ofstream(folder_ / "own.toml") << text;
    return with_overrides(load_jacket_profile(TELEHUG_SOURCE "/deploy/jackets/duemilanove-12-heaters-2.toml").value(),
                          folder_ / "own.toml");
  }
  [[nodiscard]] std::string fault(const std::string& text) const {
    const auto result = with(text);
    return result ? "none" : result.error().message;
  }

  std::filesystem::path folder_;
};

TEST_F(JacketOverridesTest, LowerLimitsAndSwitchActuatorsOff) {
  const auto profile = with(R"(version = 2
max_strength = 0.6
[[actuator]]
id = 4
max_strength = 0.5
max_duty = 0.3
[[actuator]]
id = 5
enabled = false
[[actuator]]
id = 21
max_celsius = 36
)");
  ASSERT_TRUE(profile) << profile.error().message;
  const auto actuator = [&](std::uint8_t id) { return profile->actuators.at(profile->index_of(id).value()); };
  EXPECT_EQ(actuator(3).max_strength, 0.6);
  EXPECT_EQ(actuator(4).max_strength, 0.5);
  EXPECT_EQ(actuator(4).max_duty, 0.3);
  EXPECT_TRUE(actuator(4).enabled);
  EXPECT_FALSE(actuator(5).enabled);
  EXPECT_EQ(actuator(21).max_celsius, 36);
  EXPECT_EQ(actuator(22).max_celsius, 39);
  EXPECT_THAT(profile->notes, Contains(HasSubstr("\"breastbone\" is switched off by")));
}

TEST_F(JacketOverridesTest, AllowNothingThatTheProfileDoesNot) {
  const std::string four = "version = 2\n[[actuator]]\nid = 4\n";
  EXPECT_THAT(fault(four + "max_strength = 0.9\n"), HasSubstr(":4: actuator 1: max_strength is 0.9 but must be"));
  EXPECT_THAT(fault(four + "max_strength = nan\n"), HasSubstr("max_strength is nan"));
  EXPECT_THAT(fault(four + "max_duty = 0.7\n"), HasSubstr("max_duty is 0.7"));
  EXPECT_THAT(fault("version = 2\n[[actuator]]\nid = 21\nmax_celsius = 39.5\n"), HasSubstr("max_celsius is 39.5"));
  const auto profile = with("version = 2\nmax_strength = 1\n");
  ASSERT_TRUE(profile);
  EXPECT_EQ(profile->actuators.front().max_strength, 0.6) << "a limit for all raises none";
}

TEST_F(JacketOverridesTest, SwitchOffWhatMayNotTurnAnyMore) {
  const auto profile = with("version = 2\nmax_strength = 0.2\n");
  ASSERT_TRUE(profile);
  EXPECT_FALSE(profile->actuators.front().enabled) << "it starts at 0.25";
  EXPECT_TRUE(profile->actuators.back().enabled) << "a heater";
}

TEST_F(JacketOverridesTest, RefuseWhatCannotBeMeant) {
  EXPECT_THAT(fault("version = 1\n"), HasSubstr("version is 1"));
  EXPECT_THAT(fault("version = 2\nstrength = 1\n"), HasSubstr("unknown key strength"));
  EXPECT_THAT(fault("version = 2\nactuator = 3\n"), HasSubstr("[[actuator]] tables"));
  EXPECT_THAT(fault("version = 2\n[[actuator]]\nid = 99\n"), HasSubstr("99 is none of"));
  EXPECT_THAT(fault("version = 2\n[[actuator]]\nid = 4\n[[actuator]]\nid = 4\n"), HasSubstr("stands here twice"));
  EXPECT_THAT(fault("version = 2\n[[actuator]]\nid = 4\nmax_celsius = 35\n"), HasSubstr("this is a motor"));
  EXPECT_THAT(fault("version = 2\n[[actuator]]\nid = 21\nmax_duty = 0.5\n"), HasSubstr("this is a heater"));
  EXPECT_THAT(fault("version = 2\n[[actuator]]\nid = 4\nenabled = 0\n"), HasSubstr("must be true or false"));
}

TEST_F(JacketOverridesTest, RefuseToLeaveNothing) {
  std::string all = "version = 2\n";
  for (const int id : {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 21, 22})
    all += "[[actuator]]\nid = " + std::to_string(id) + "\nenabled = false\n";
  EXPECT_THAT(fault(all), HasSubstr("no actuator of the jacket is left"));
  EXPECT_THAT(fault("version = 2\nmax_strength = 0\n"), HasSubstr("no actuator of the jacket is left"));
}

TEST_F(JacketOverridesTest, SayWhatToDoWhenTheirFileIsMissing) {
  const auto result = with_overrides({}, folder_ / "none.toml");
  ASSERT_FALSE(result);
  EXPECT_THAT(result.error().message, HasSubstr("correct jacket.overrides, or leave it empty"));
}

}  // namespace
}  // namespace telehug
