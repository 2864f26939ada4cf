// SPDX-License-Identifier: Apache-2.0
#include "consent_file.hpp"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <fstream>
#include <random>
#include <string>

#include "doubles/temporary_folder.hpp"

namespace telehug {
namespace {

using testing::HasSubstr;

class ConsentFile : public testing::Test {
 protected:
  void write(const std::string& text) const { std::ofstream(file) << text; }

  TemporaryFolder folder;
  std::filesystem::path file = folder / "state" / "consent.json";
};

Consent something() {
  Consent consent;
  consent.pause = Pause{std::chrono::sys_seconds(std::chrono::seconds(1'800'000'000))};
  consent.muted_boxes.set(8).set(100);
  consent.muted_actuators.set(1).set(255);
  consent.strength = 0.35;
  consent.own_quiet_hours = {{20 * 60 + 30, 7 * 60}, {13 * 60, 14 * 60}};
  return consent;
}

TEST_F(ConsentFile, holds_nothing_if_it_is_not_there) {
  EXPECT_EQ(read_consent(file).value(), Consent{});
}

TEST_F(ConsentFile, is_read_as_it_was_kept_by_nobody_but_its_owner) {
  Consent consent = something();
  ASSERT_TRUE(keep_consent(file, consent));
  EXPECT_EQ(read_consent(file).value(), consent);
  struct stat status {};
  ASSERT_EQ(stat(file.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777U, 0600U);
  consent.pause = Pause{};
  ASSERT_TRUE(keep_consent(file, consent)) << "over the one before";
  EXPECT_EQ(read_consent(file).value(), consent);
  ASSERT_TRUE(keep_consent(file, Consent{}));
  EXPECT_EQ(read_consent(file).value(), Consent{});
}

TEST_F(ConsentFile, of_a_version_that_knew_no_strength_means_all_of_it) {
  const auto old = parse_consent(R"({"format":1,"paused":false,"muted_boxes":[8],"muted_actuators":[]})");
  ASSERT_TRUE(old);
  EXPECT_EQ(old->strength, 1);
  EXPECT_TRUE(old->muted_boxes.test(8));
}

TEST_F(ConsentFile, is_damaged_by_a_strength_that_is_none) {
  for (const char* strength : {"0", "-0.5", "1.01", "\"1\"", "null", "true", "1e400"}) {
    const std::string text =
        std::string(R"({"format":1,"paused":false,"muted_boxes":[],"muted_actuators":[],"strength":)") + strength + "}";
    EXPECT_FALSE(parse_consent(text)) << strength;
  }
}

TEST_F(ConsentFile, of_a_version_that_knew_no_own_quiet_hours_has_none) {
  const auto old = parse_consent(R"({"format":1,"paused":true,"muted_boxes":[],"muted_actuators":[],"strength":0.5})");
  ASSERT_TRUE(old);
  EXPECT_TRUE(old->own_quiet_hours.empty());
  EXPECT_EQ(old->strength, 0.5);
}

TEST_F(ConsentFile, is_damaged_by_quiet_hours_that_are_none) {
  for (const char* hours : {"20", "\"20:30\"", "\"20:30-20:30\"", "null", "[]", "\"20:30-07:00,\""}) {
    const std::string text =
        std::string(R"({"format":1,"paused":false,"muted_boxes":[],"muted_actuators":[],"quiet_hours":)") + hours + "}";
    EXPECT_FALSE(parse_consent(text)) << hours;
  }
}

TEST_F(ConsentFile, keeps_no_quiet_hours_of_the_configuration) {
  Consent consent;
  consent.quiet_hours = {{0, 60}};
  ASSERT_TRUE(keep_consent(file, consent));
  EXPECT_TRUE(read_consent(file)->quiet_hours.empty());
}

TEST_F(ConsentFile, is_damaged_unless_it_is_whole) {
  ASSERT_TRUE(keep_consent(file, something()));
  std::ifstream stream(file);
  std::string text;
  std::getline(stream, text);
  for (std::size_t length = 0; length < text.size(); ++length) {
    write(text.substr(0, length));
    const auto read = read_consent(file);
    ASSERT_FALSE(read) << length;
    EXPECT_THAT(read.error().message, HasSubstr("damaged"));
  }
}

TEST_F(ConsentFile, is_damaged_if_it_holds_anything_else) {
  for (const char* text :
       {"", "{}", "[]", "null", R"({"format":2,"paused":false,"muted_boxes":[],"muted_actuators":[]})",
        R"({"format":1,"paused":null,"muted_boxes":[],"muted_actuators":[]})",
        R"({"format":1,"paused":-1,"muted_boxes":[],"muted_actuators":[]})",
        R"({"format":1,"paused":1e300,"muted_boxes":[],"muted_actuators":[]})",
        R"({"format":1,"paused":18446744073709551615,"muted_boxes":[],"muted_actuators":[]})",
        R"({"format":1,"paused":false,"muted_boxes":[0],"muted_actuators":[]})",
        R"({"format":1,"paused":false,"muted_boxes":[101],"muted_actuators":[]})",
        R"({"format":1,"paused":false,"muted_boxes":[],"muted_actuators":[256]})",
        R"({"format":1,"paused":false,"muted_boxes":{},"muted_actuators":[]})",
        R"({"format":1,"paused":false,"muted_boxes":["8"],"muted_actuators":[]})",
        R"({"format":1,"paused":false,"muted_boxes":[],"muted_actuators":[],"more":1})"}) {
    EXPECT_FALSE(parse_consent(text)) << text;
  }
  EXPECT_TRUE(parse_consent(R"({"format":1,"paused":false,"muted_boxes":[],"muted_actuators":[]})"));
}

TEST_F(ConsentFile, can_not_be_read_if_it_is_no_file) {
  std::filesystem::create_directories(file);
  EXPECT_FALSE(read_consent(file));
}

TEST_F(ConsentFile, says_why_it_can_not_be_kept) {
  std::filesystem::create_directories(file.parent_path());
  std::filesystem::create_directories(file / "full");
  const auto kept = keep_consent(file, something());
  ASSERT_FALSE(kept);
  EXPECT_THAT(kept.error().message, HasSubstr(file.string()));
}

TEST_F(ConsentFile, bears_any_bytes) {
  std::mt19937 random(9);
  const std::string whole = R"({"format":1,"paused":1800000000,"muted_boxes":[8,13],"muted_actuators":[3]})";
  for (int round = 0; round < 20000; ++round) {
    std::string text = whole;
    for (unsigned n = random() % 4 + 1; n > 0; --n)
      text[random() % text.size()] = static_cast<char>(random() % 256);
    (void)parse_consent(text);
  }
}

}  // namespace
}  // namespace telehug
