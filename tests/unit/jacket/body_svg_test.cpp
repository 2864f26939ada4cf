// SPDX-License-Identifier: Apache-2.0
#include "jacket/body_svg.hpp"

#include <gmock/gmock.h>

#include "jacket/load_jacket_profile.hpp"

namespace telehug {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++found;
  return found;
}

TEST(BodySvg, ShowsEveryActuatorAndWhichRun) {
  auto profile = load_jacket_profile(TELEHUG_SOURCE "/deploy/jackets/duemilanove-12-heaters-2.toml").value();
  profile.actuators[2].enabled = false;
  const std::string svg = body_svg(profile, std::vector<std::uint8_t>{1, 21});
  EXPECT_EQ(count(svg, "<circle"), 12U);
  EXPECT_EQ(count(svg, "<rect"), 2U);
  EXPECT_EQ(count(svg, "class='runs'"), 2U);
  EXPECT_EQ(count(svg, "class='off'"), 1U);
  EXPECT_EQ(count(svg, "<g"), count(svg, "</g>"));
}

TEST(BodySvg, TellsPagesWhichActuatorIsWhichAndWhereTheBoxesAre) {
  const auto profile = load_jacket_profile(TELEHUG_SOURCE "/deploy/jackets/duemilanove-16.toml").value();
  const std::string svg = body_svg(profile, {});
  for (const Actuator& actuator : profile.actuators)
    EXPECT_EQ(count(svg, "data-actuator='" + std::to_string(actuator.id) + "'"), 1U);
  // Five boxes of half a face height (70 px) each way, from the chin down, about the middle of each body.
  EXPECT_THAT(svg, HasSubstr("data-side='front' data-grid='49 205 350 350'"));
  EXPECT_THAT(svg, HasSubstr("data-side='back' data-grid='497 205 350 350'"));
}

TEST(BodySvg, TakesNamesForText) {
  JacketProfile profile;
  profile.name = "<b> & \"c\"";
  profile.actuators.resize(1);
  profile.actuators[0].name = "a\x01<script>";
  const std::string svg = body_svg(profile, {});
  EXPECT_THAT(svg, HasSubstr("&lt;b&gt; &amp; &quot;c&quot;"));
  EXPECT_THAT(svg, Not(HasSubstr("<script>")));
  EXPECT_THAT(svg, Not(HasSubstr("\x01")));
}

}  // namespace
}  // namespace telehug
