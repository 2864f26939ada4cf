// SPDX-License-Identifier: Apache-2.0
//
// Whatever a set-up may advise has a sentence on the page.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "setup/setup_state.hpp"

namespace telehug {
namespace {

TEST(TheSetUpPage, HasASentenceForEveryAdviceAndStep) {
  const auto texts = nlohmann::json::parse(std::ifstream(TELEHUG_SOURCE "/active_side/web/texts.en.json"));
  for (int code = 1; code <= static_cast<int>(SetupAdvice::idle); ++code) {
    const std::string name = name_of(static_cast<SetupAdvice>(code));
    EXPECT_TRUE(texts.contains("advice." + name)) << name;
  }
  for (const SetupStep step : {SetupStep::bright, SetupStep::confirm_border, SetupStep::background, SetupStep::marks})
    EXPECT_TRUE(texts.contains(std::string("setup.now_") + name_of(step))) << name_of(step);
  for (const char* why : {"cancelled", "idle", "unfollowed", "stopped", "failed"})
    EXPECT_TRUE(texts.contains(std::string("setup.ended_") + why)) << why;
}

}  // namespace
}  // namespace telehug
