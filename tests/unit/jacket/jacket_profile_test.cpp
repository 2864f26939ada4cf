// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

#include "jacket/load_jacket_profile.hpp"

namespace telehug {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class JacketProfileTest : public ::testing::Test {
 protected:
  JacketProfileTest() {
    std::string pattern = ::testing::TempDir() + "telehug-jacket-XXXXXX";
    folder_ = mkdtemp(pattern.data());
  }
  ~JacketProfileTest() override { std::filesystem::remove_all(folder_); }

  Result<JacketProfile> load(const std::string& text) const {
    std::ofstream(folder_ / "jacket.toml") << text;
    return load_jacket_profile(folder_ / "jacket.toml");
  }
  // The faults that it finds, without the folder: "jacket.toml:LINE: sentence".
  std::vector<std::string> faults(const std::string& text) const {
    const auto loaded = load(text);
    std::vector<std::string> lines;
    if (loaded) return lines;
    std::istringstream all(loaded.error().message);
    for (std::string line; std::getline(all, line);)
      lines.push_back(line.substr(line.find("jacket.toml")));
    return lines;
  }

  std::filesystem::path folder_;
};

const std::string head = R"(version = 1
name = "Vest"
baud = 57600
uncovered = "none"
)";
const std::string one_motor = R"([[actuator]]
id = 7
name = "breastbone"
kind = "motor"
channel = 3
x_fh = 0
y_fh = 0.75
side = "front"
boxes = [8, 13]
)";

TEST_F(JacketProfileTest, reads_all_there_is) {
  const auto loaded =
      load(head + "[defaults]\nmax_strength = 0.8\nmin_strength = 0.3\n" + one_motor + "max_strength = 0.6\n");
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(loaded->version, 1);
  EXPECT_EQ(loaded->name, "Vest");
  EXPECT_EQ(loaded->baud, 57600);
  EXPECT_EQ(loaded->uncovered, Uncovered::none);
  ASSERT_EQ(loaded->actuators.size(), 1U);
  const Actuator& actuator = loaded->actuators[0];
  EXPECT_EQ(actuator.id, 7);
  EXPECT_EQ(actuator.name, "breastbone");
  EXPECT_EQ(actuator.kind, ActuatorKind::motor);
  EXPECT_EQ(actuator.channel, 3);
  EXPECT_EQ(actuator.place.x_fh, 0);
  EXPECT_EQ(actuator.place.y_fh, 0.75);
  EXPECT_EQ(actuator.side, BodySide::front);
  EXPECT_THAT(actuator.boxes, ElementsAre(8, 13));
  EXPECT_EQ(actuator.max_strength, 0.6);
  EXPECT_EQ(actuator.min_strength, 0.3);
  EXPECT_EQ(loaded->index_of(7), 0U);
  EXPECT_EQ(loaded->index_of(8), std::nullopt);
}

TEST_F(JacketProfileTest, notes_boxes_that_nobody_serves_without_calling_it_a_fault) {
  const auto loaded = load(head + one_motor);
  ASSERT_TRUE(loaded);
  EXPECT_THAT(loaded->notes, ElementsAre(AllOf(HasSubstr("box 1, 2, 3, 4, 5, 6, 7, 9,"), EndsWith("are not felt"))));
}

TEST_F(JacketProfileTest, lists_all_faults_at_once_each_with_its_line) {
  const std::string text = R"(version = 2
name = ""
baud = 12345
colour = "red"
uncovered = "maybe"
[defaults]
max_strength = 1.5
[[actuator]]
id = 1
name = "a"
kind = "heater"
channel = 16
x_fh = nan
y_fh = inf
side = "top"
boxes = [0]
[[actuator]]
id = 2
name = "b"
kind = "motor"
channel = 4
x_fh = 0.0
y_fh = "low"
side = "back"
strength = 1
[[actuator]]
id = 2
name = "c"
kind = "motor"
channel = 4
x_fh = 0.0
side = "back"
min_strength = 0.9
max_strength = 0.5
)";
  EXPECT_THAT(
      faults(text),
      ElementsAre(HasSubstr(":1: profile: version is 2 but must be 1..1"), HasSubstr(":2: profile: name is empty"),
                  HasSubstr(":3: profile: baud is 12345"), HasSubstr(":4: profile: unknown key colour"),
                  HasSubstr(":5: profile: uncovered is \"maybe\" but must be \"nearest\" or \"none\""),
                  HasSubstr(":7: defaults: max_strength is 1.5"), HasSubstr(":11: actuator 1: kind is \"heater\""),
                  HasSubstr(":12: actuator 1: channel is 16 but must be 0..15"),
                  HasSubstr(":13: actuator 1: x_fh is nan"), HasSubstr(":14: actuator 1: y_fh is inf"),
                  HasSubstr(":15: actuator 1: side is \"top\""), HasSubstr(":16: actuator 1: boxes must be"),
                  HasSubstr(":23: actuator 2: y_fh must be a number"),
                  HasSubstr(":25: actuator 2: unknown key strength"), HasSubstr(":26: actuator 3 has no y_fh; add it"),
                  HasSubstr(":27: actuator 3: id 2 is already taken by \"b\""),
                  HasSubstr(":30: actuator 3: channel 4 already drives \"b\""),
                  HasSubstr(":33: actuator 3: min_strength leaves nothing")));
}

TEST_F(JacketProfileTest, refuses_a_jacket_without_actuators) {
  EXPECT_THAT(faults(head), ElementsAre(HasSubstr("has no actuators")));
  EXPECT_THAT(faults(head + "actuator = []\n"), ElementsAre(HasSubstr("has no actuators")));
  EXPECT_THAT(faults(head + "actuator = [3]\n"), ElementsAre(HasSubstr("[[actuator]] tables")));
  EXPECT_THAT(faults(head + "actuator = 3\n"), ElementsAre(HasSubstr("has no actuators")));
}

TEST_F(JacketProfileTest, refuses_whole_numbers_and_texts_of_another_type) {
  const auto found = faults("version = 1.0\nname = 5\nbaud = \"57600\"\nuncovered = true\ndefaults = 1\n" + one_motor);
  EXPECT_EQ(found.size(), 5U);
}

TEST_F(JacketProfileTest, says_where_a_file_is_no_toml) {
  EXPECT_THAT(faults("version = 1\nname = \n"), ElementsAre(HasSubstr("jacket.toml:2: not valid TOML")));
}

// toml++ takes tables within tables apart recursively.
TEST_F(JacketProfileTest, refuses_a_line_of_a_hundred_thousand_tables) {
  std::string key = "a";
  for (int i = 0; i < 100'000; ++i)
    key += ".a";
  EXPECT_THAT(faults("version = 1\n" + key + " = 1"), ElementsAre(HasSubstr("line 2 is longer")));
}

TEST_F(JacketProfileTest, says_that_a_file_is_not_there) {
  const auto loaded = load_jacket_profile(folder_ / "none.toml");
  ASSERT_FALSE(loaded);
  EXPECT_THAT(loaded.error().message, HasSubstr("there is no such jacket profile"));
  EXPECT_FALSE(load_jacket_profile(folder_));
}

}  // namespace
}  // namespace telehug
