// SPDX-License-Identifier: Apache-2.0
#include "service/exit_code_text.hpp"

#include <gmock/gmock.h>

#include <fstream>
#include <regex>
#include <set>

#include "cli/help_text.hpp"
#include "cli/roff.hpp"

namespace telehug {
namespace {

// The numbers of the enum as its source has them.
std::set<int> numbers_of_the_enum() {
  std::set<int> numbers;
  const std::regex row(R"(^\s+[a-z_]+ = (\d+),.*)");
  std::ifstream source(TELEHUG_SOURCE "/common/service/exit_code.hpp");
  std::smatch parts;
  for (std::string line; std::getline(source, line);)
    if (std::regex_match(line, parts, row)) numbers.insert(std::stoi(parts[1]));
  return numbers;
}

TEST(ExitCodes, EachOfTheEnumIsTold) {
  std::set<int> told;
  for (const ExitCode code : all_exit_codes) {
    EXPECT_TRUE(told.insert(to_int(code)).second) << "told twice";
    EXPECT_NE(exit_code_text(code), "");
  }
  ASSERT_GE(told.size(), 16U);
  EXPECT_EQ(told, numbers_of_the_enum());
}

TEST(ExitCodes, HelpAndManualTellTheSameOfEach) {
  for (const ExitCode code : all_exit_codes) {
    const std::string number = std::to_string(to_int(code));
    EXPECT_THAT(exit_codes_text({code}), testing::HasSubstr(number + "  " + std::string(exit_code_text(code))));
    EXPECT_EQ(roff_exit_status({code}), ".TP\n.B \"" + number + "\"\n" + roff(exit_code_text(code)) + "\n");
  }
}

}  // namespace
}  // namespace telehug
