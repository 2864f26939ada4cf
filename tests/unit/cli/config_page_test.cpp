// SPDX-License-Identifier: Apache-2.0
#include "manual/config_page.hpp"

#include <gmock/gmock.h>

#include "cli/roff.hpp"
#include "config/key.hpp"
#include "manual/page_template.hpp"

namespace telehug {
namespace {

using testing::HasSubstr;

template <typename Config>
void expect_every_key(Side side) {
  Config config;
  const std::string page = config_page(side, "2026-11-29");
  for (const Key& key : keys_of(config)) {
    EXPECT_THAT(page, HasSubstr(".SS " + roff_argument("[" + std::string(key.section) + "]") + "\n"));
    EXPECT_THAT(page, HasSubstr(".B " + roff_argument(std::string(key.name) + " = " + toml_text(key.target)) + "\n" +
                                roff(key.help)))
        << key.path();
  }
}

TEST(ConfigPage, HasEveryKeyOfTheActiveSideAtItsDefault) {
  expect_every_key<ActiveConfig>(Side::active);
}

TEST(ConfigPage, HasEveryKeyOfThePassiveSideAtItsDefault) {
  expect_every_key<PassiveConfig>(Side::passive);
}

TEST(ConfigPage, MarksWhatAReloadTakesOver) {
  const std::string page = config_page(Side::passive, "2026-11-29");
  const auto item = [&page](const std::string& name) {
    const auto at = page.find(".B " + roff_argument(name));
    return at == std::string::npos ? "" : page.substr(at, page.find("\n.", at) - at);
  };
  EXPECT_THAT(item("level = \"info\""), testing::EndsWith("[reload]"));
  EXPECT_THAT(item("max_strength = 1.0"), testing::Not(HasSubstr("[reload]")));
}

TEST(FilledPage, PutsDateVersionAndExitCodesIn) {
  EXPECT_EQ(filled_page("of @DATE@.", "2026-11-29"), "of 2026-11-29.");
  EXPECT_THAT(filled_page("@EXIT_STATUS@", ""), HasSubstr("revoked"));
}

TEST(FilledPage, RefusesAWordThatStandsForNothing) {
  EXPECT_THROW((void)filled_page("@DAY@", ""), std::runtime_error);
  EXPECT_THROW((void)filled_page("a@b", ""), std::runtime_error);
}

}  // namespace
}  // namespace telehug
