// SPDX-License-Identifier: Apache-2.0
#include "jacket/body_picture.hpp"

#include <gmock/gmock.h>

#include "jacket/load_jacket_profile.hpp"
#include "unit/jacket/jacket_builders.hpp"

namespace telehug {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

int characters(const std::string& utf8) {
  return static_cast<int>(std::ranges::count_if(utf8, [](char byte) { return (byte & 0xC0) != 0x80; }));
}
int count(const std::vector<std::string>& lines, const std::string& what) {
  int found = 0;
  for (const std::string& line : lines) {
    for (auto at = line.find(what); at != std::string::npos; at = line.find(what, at + what.size()))
      ++found;
  }
  return found;
}

TEST(BodyPicture, shows_every_motor_once_and_fills_those_that_run) {
  const auto profile = load_jacket_profile(TELEHUG_SOURCE "/deploy/jackets/duemilanove-16.toml");
  ASSERT_TRUE(profile);
  const std::uint8_t running[]{7, 16};
  const auto lines = body_picture(profile.value(), running);
  EXPECT_EQ(count(lines, "○"), 14);
  EXPECT_EQ(count(lines, "●"), 2);
  EXPECT_EQ(count(lines, "●7 "), 1);
  EXPECT_EQ(count(lines, "●16"), 1);
}

TEST(BodyPicture, fits_a_terminal_wherever_the_motors_are) {
  const JacketProfile profile =
      profile_of({motor(1, {-5, -5}, {}), motor(2, {5, 5}, {}), motor(255, {5, -5}, {}), motor(9, {-5, 5}, {})});
  const auto lines = body_picture(profile, {});
  EXPECT_EQ(count(lines, "○"), 4);
  EXPECT_LE(lines.size(), 16U);
  for (const std::string& line : lines)
    EXPECT_LE(characters(line), 60) << line;
  EXPECT_THAT(lines.front(), HasSubstr("○255"));
}

TEST(BodyPicture, puts_a_positive_x_to_the_right_and_a_larger_y_lower) {
  const auto lines = body_picture(profile_of({motor(1, {-0.5, 0.5}, {}), motor(2, {0.5, 1.5}, {})}), {});
  const auto row_of = [&](const std::string& label) {
    return std::ranges::find_if(lines, [&](const std::string& line) { return line.find(label) != std::string::npos; });
  };
  ASSERT_LT(row_of("○1"), row_of("○2"));
  EXPECT_LT(row_of("○1")->find("○1"), row_of("○2")->find("○2"));
}

TEST(BodyPicture, shows_one_side_of_the_body) {
  JacketProfile profile = profile_of({motor(1, {0, 1}, {}), motor(2, {0.5, 1}, {})});
  profile.actuators[1].side = BodySide::back;
  EXPECT_EQ(count(body_picture(profile, {}), "○2"), 0);
  EXPECT_EQ(count(body_picture(profile, {}, BodySide::back), "○2"), 1);
}

}  // namespace
}  // namespace telehug
