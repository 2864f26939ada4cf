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

const std::string head = R"(version = 2
name = "Vest"
baud = 57600
uncovered = "none"
rendering = "boxes"
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

// Channel 1 is another than a motor's channel 1.
const std::string one_heater = R"([[actuator]]
id = 9
name = "back, warm"
kind = "heater"
channel = 1
x_fh = 0
y_fh = 1
side = "back"
max_celsius = 38.5
)";

TEST_F(JacketProfileTest, reads_all_there_is) {
  const auto loaded =
      load(head +
           "protocol = \"telehug\"\nlink = \"bluetooth\"\nsupply_ma = 900\nduty_window_s = 8\n"
           "[defaults]\nmax_strength = 0.8\nmin_strength = 0.3\ngamma = 1.5\nkick_ms = 40\ncurrent_ma = 75\n" +
           one_motor + "max_strength = 0.6\nmax_duty = 0.5\n" + one_heater);
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(loaded->version, 2);
  EXPECT_EQ(loaded->name, "Vest");
  EXPECT_EQ(loaded->baud, 57600);
  EXPECT_EQ(loaded->protocol, JacketProtocol::telehug);
  EXPECT_EQ(loaded->wire, JacketWire::bluetooth);
  EXPECT_EQ(loaded->uncovered, Uncovered::none);
  EXPECT_EQ(loaded->rendering, Rendering::boxes);
  EXPECT_EQ(loaded->supply_ma, 900);
  EXPECT_EQ(loaded->duty_window, 8s);
  ASSERT_EQ(loaded->actuators.size(), 2U);
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
  EXPECT_TRUE(actuator.enabled);
  EXPECT_EQ(actuator.gamma, 1.5);
  EXPECT_EQ(actuator.kick, 40ms);
  EXPECT_EQ(actuator.current_ma, 75);
  EXPECT_EQ(actuator.max_duty, 0.5);
  const Actuator& heater = loaded->actuators[1];
  EXPECT_EQ(heater.kind, ActuatorKind::heater);
  EXPECT_EQ(heater.channel, 1);
  EXPECT_EQ(heater.max_celsius, 38.5);
  EXPECT_EQ(loaded->index_of(7), 0U);
  EXPECT_EQ(loaded->index_of(8), std::nullopt);
}

TEST_F(JacketProfileTest, notes_boxes_that_nobody_serves_without_calling_it_a_fault) {
  const auto loaded = load(head + one_motor);
  ASSERT_TRUE(loaded);
  EXPECT_THAT(loaded->notes, ElementsAre(AllOf(HasSubstr("box 1, 2, 3, 4, 5, 6, 7, 9,"), EndsWith("are not felt"))));
}

TEST_F(JacketProfileTest, lists_all_faults_at_once_each_with_its_line) {
  const std::string text = R"(version = 3
name = ""
baud = 12345
colour = "red"
uncovered = "maybe"
rendering = "boxes"
[defaults]
max_strength = 1.5
[[actuator]]
id = 1
name = "a"
kind = "fan"
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
      ElementsAre(HasSubstr(":1: profile: version is 3 but must be 2..2"), HasSubstr(":2: profile: name is empty"),
                  HasSubstr(":3: profile: baud is 12345"), HasSubstr(":4: profile: unknown key colour"),
                  HasSubstr(":5: profile: uncovered is \"maybe\" but must be \"nearest\" or \"none\""),
                  HasSubstr(":8: defaults: max_strength is 1.5"), HasSubstr(":12: actuator 1: kind is \"fan\""),
                  HasSubstr(":13: actuator 1: channel is 16 but must be 0..15"),
                  HasSubstr(":14: actuator 1: x_fh is nan"), HasSubstr(":15: actuator 1: y_fh is inf"),
                  HasSubstr(":16: actuator 1: side is \"top\""), HasSubstr(":17: actuator 1: boxes must be"),
                  HasSubstr(":24: actuator 2: y_fh must be a number"),
                  HasSubstr(":26: actuator 2: unknown key strength"), HasSubstr(":27: actuator 3 has no y_fh; add it"),
                  HasSubstr(":28: actuator 3: id 2 is already taken by \"b\""),
                  HasSubstr(":31: actuator 3: channel 4 already drives \"b\""),
                  HasSubstr(":34: actuator 3: min_strength leaves nothing")));
}

TEST_F(JacketProfileTest, refuses_a_jacket_without_actuators) {
  EXPECT_THAT(faults(head), ElementsAre(HasSubstr("has no actuators")));
  EXPECT_THAT(faults(head + "actuator = []\n"), ElementsAre(HasSubstr("has no actuators")));
  EXPECT_THAT(faults(head + "actuator = [3]\n"), ElementsAre(HasSubstr("[[actuator]] tables")));
  EXPECT_THAT(faults(head + "actuator = 3\n"), ElementsAre(HasSubstr("has no actuators")));
}

TEST_F(JacketProfileTest, refuses_whole_numbers_and_texts_of_another_type) {
  const auto found = faults(
      "version = 2.0\nname = 5\nbaud = \"57600\"\nuncovered = true\nrendering = \"boxes\"\ndefaults = 1\n" + one_motor);
  EXPECT_EQ(found.size(), 5U);
}

TEST_F(JacketProfileTest, keeps_heaters_below_what_skin_may_have) {
  const auto with = [](const std::string& celsius) {
    std::string heater = one_heater;
    return head + heater.replace(heater.find("38.5"), 4, celsius);
  };
  EXPECT_TRUE(load(with("40")));
  EXPECT_THAT(faults(with("40.1")), ElementsAre(HasSubstr("max_celsius is 40.1 but must be 32..40")));
  EXPECT_THAT(faults(with("nan")), ElementsAre(HasSubstr("max_celsius is nan")));
}

TEST_F(JacketProfileTest, refuses_what_a_legacy_jacket_can_t_do) {
  const std::string legacy = R"(version = 2
name = "Vest"
baud = 57600
protocol = "legacy"
uncovered = "none"
rendering = "places"
)";
  EXPECT_THAT(faults(legacy + one_motor + one_heater),
              ElementsAre(HasSubstr("protocol must be \"telehug\" for the heater \"back, warm\""),
                          HasSubstr("rendering must be \"boxes\"")));
}

TEST_F(JacketProfileTest, loads_every_shipped_jacket) {
  int jackets = 0;
  for (const auto& file : std::filesystem::directory_iterator(TELEHUG_SOURCE "/deploy/jackets")) {
    if (file.path().extension() != ".toml") continue;
    const auto loaded = load_jacket_profile(file.path());
    EXPECT_TRUE(loaded) << loaded.error().message;
    ++jackets;
  }
  EXPECT_EQ(jackets, 4);
}

TEST_F(JacketProfileTest, says_where_a_file_is_no_toml) {
  EXPECT_THAT(faults("version = 2\nname = \n"), ElementsAre(HasSubstr("jacket.toml:2: not valid TOML")));
}

// toml++ takes tables within tables apart recursively.
TEST_F(JacketProfileTest, refuses_a_line_of_a_hundred_thousand_tables) {
  std::string key = "a";
  for (int i = 0; i < 100'000; ++i)
    key += ".a";
  EXPECT_THAT(faults("version = 2\n" + key + " = 1"), ElementsAre(HasSubstr("line 2 is longer")));
}

TEST_F(JacketProfileTest, says_that_a_file_is_not_there) {
  const auto loaded = load_jacket_profile(folder_ / "none.toml");
  ASSERT_FALSE(loaded);
  EXPECT_THAT(loaded.error().message, HasSubstr("there is no such jacket profile"));
  EXPECT_FALSE(load_jacket_profile(folder_));
}

}  // namespace
}  // namespace telehug
